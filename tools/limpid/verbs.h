#pragma once
#include "arguments.h"

/// The verbs of the tool. Each returns the exit code and throws limpid::Error, which main() prints
/// as a sentence.

namespace limpid::tool {

int composite_verb(const CompositeArguments& arguments, const CommonArguments& common);
int render_verb(const RenderArguments& arguments, const CommonArguments& common);
int water_verb(const RenderArguments& arguments, const CommonArguments& common);
int truth_verb(const TruthArguments& arguments, const CommonArguments& common);
int plan_verb(const CompositeArguments& arguments, const CommonArguments& common);
int view_verb(const ViewArguments& arguments, const CommonArguments& common);
int inspect_verb(const InspectArguments& arguments, const CommonArguments& common);
int operators_verb(const OperatorsArguments& arguments);
int looks_verb(const LooksArguments& arguments, const CommonArguments& common);
int compare_verb(const CompareArguments& arguments, const CommonArguments& common);
int shader_verb(const ShaderArguments& arguments, const CommonArguments& common);
int farm_verb(const FarmArguments& arguments, const CommonArguments& common);
int report_verb(const ReportArguments& arguments, const CommonArguments& common);

}  // namespace limpid::tool
