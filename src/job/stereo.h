#pragma once
#include <string>
#include <vector>

#include "limpid/job/composite.h"

#include "job/composite_view.h"
#include "job/provenance.h"

/// @file
/// Rules and reports for several views of one frame.

namespace limpid {

/// Throws Error for two views of one name, two with the same camera, different display windows, and
/// for a deep file, which holds one view.
void expect_views(const CompositeJob& job, const std::vector<PreparedView>& views);

/// Adds another view's report, except times, which the caller measures.
void add_view(CompositeReport& report, const std::string& view, const CompositeReport& other);

/// Adds another view's record under "limpid/view/NAME/...".
void add_view(Record& record, const std::string& view, const Record& other);
/// Extracts that record again.
Record record_of_view(const Record& record, const std::string& view);

}  // namespace limpid
