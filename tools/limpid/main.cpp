#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "limpid/core/error.h"

#include "memory_limit.h"
#include "notes.h"
#include "signals.h"
#include "streams.h"
#include "verbs.h"

namespace {

int exit_code_of(limpid::Fault fault) {
  switch (fault) {
    case limpid::Fault::kUsage:
      return 2;
    case limpid::Fault::kRetry:
      return 75;
    case limpid::Fault::kJob:
      break;
  }
  return 1;
}

void print_error(const std::string& sentence) {
  std::fprintf(stderr, "limpid ERROR: %s\n", limpid::tool::one_line(sentence).c_str());
}

int run(const limpid::tool::Arguments& a) {
  using limpid::tool::Verb;
  limit_process(a.common);
  switch (a.verb) {
    case Verb::kComposite:
      return composite_verb(a.composite, a.common);
    case Verb::kPlan:
      return plan_verb(a.composite, a.common);
    case Verb::kRender:
      return render_verb(a.render, a.common);
    case Verb::kWater:
      return water_verb(a.render, a.common);
    case Verb::kTruth:
      return truth_verb(a.truth, a.common);
    case Verb::kInspect:
      return inspect_verb(a.inspect, a.common);
    case Verb::kOperators:
      return operators_verb(a.operators);
    case Verb::kCompare:
      return compare_verb(a.compare, a.common);
    case Verb::kReport:
      return report_verb(a.report, a.common);
    case Verb::kNone:
      break;
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  limpid::tool::keep_streams_apart();
  const limpid::tool::Parsed parsed = limpid::tool::parse(argc, argv);
  try {
    int code = parsed.exit_code.value_or(0);
    if (!parsed.exit_code) {
      limpid::tool::end_cleanly_on_signals();
      code = run(parsed.arguments);
    }
    limpid::tool::finish_stdout();
    return code;
  } catch (const limpid::Error& error) {
    print_error(error.what());
    return exit_code_of(error.fault());
  } catch (const std::bad_alloc&) {
    const std::optional<std::string>& most = parsed.arguments.common.max_memory;
    print_error(most ? "needs more memory than --max-memory " + *most : "out of memory");
    return most ? 1 : 75;
  } catch (const std::exception& error) {
    print_error(error.what());
    return 1;
  }
}
