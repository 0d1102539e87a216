#pragma once
#include <string>
#include <vector>

#include "limpid/job/composite.h"

#include "job/composite_view.h"
#include "job/provenance.h"

/// @file
/// What several views of one frame have to agree on, and what is said of all of them.

namespace limpid {

/// Throws the Error of several views for two of one name, for two with the same camera, for other
/// display windows, and for a deep file, which holds one view.
void expect_views(const CompositeJob& job, const std::vector<PreparedView>& views);

/// Adds what another view reports: times are the caller's.
void add_view(CompositeReport& report, const std::string& view, const CompositeReport& other);

/// Adds another view's record under "limpid/view/NAME/...".
void add_view(Record& record, const std::string& view, const Record& other);
/// That record again.
Record record_of_view(const Record& record, const std::string& view);

}  // namespace limpid
