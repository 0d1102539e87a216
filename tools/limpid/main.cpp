#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "limpid/core/error.h"

#include "memory_limit.h"
#include "notes.h"
#include "out_of_memory.h"
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
    case limpid::Fault::kMemory:
      return limpid::tool::memory_exit_code();
    case limpid::Fault::kJob:
      break;
  }
  return 1;
}

void print_error(const std::string& sentence) {
  std::fprintf(stderr, "limpid ERROR: %s\n", limpid::tool::one_line(sentence).c_str());
}

/// Immediately: exit handlers of libraries may need memory.
[[noreturn]] void end_out_of_memory(const std::string& sentence) {
  std::fflush(stdout);
  print_error(limpid::tool::out_of_memory(sentence));
  std::_Exit(exit_code_of(limpid::Fault::kMemory));
}

int run(const limpid::tool::Arguments& a) {
  using limpid::tool::Verb;
  limpid::tool::note_memory_limits(a.common);
  if (limpid::tool::is_memory_limited()) limpid::tool::make_threads_small();
  limit_process(a.common);
  limpid::tool::end_cleanly_on_signals();
  switch (a.verb) {
    case Verb::kComposite:
      return composite_verb(a.composite, a.common);
    case Verb::kPlan:
      return plan_verb(a.composite, a.common);
    case Verb::kView:
      return view_verb(a.view, a.common);
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
    case Verb::kLooks:
      return looks_verb(a.looks, a.common);
    case Verb::kCompare:
      return compare_verb(a.compare, a.common);
    case Verb::kShader:
      return shader_verb(a.shader, a.common);
    case Verb::kFarm:
      return farm_verb(a.farm, a.common);
    case Verb::kReport:
      return report_verb(a.report, a.common);
    case Verb::kNone:
      break;
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace limpid::tool;
  keep_streams_apart();
  end_when_memory_ends();
  try {
    const Parsed parsed = parse(argc, argv);
    int code = parsed.exit_code.value_or(0);
    if (!parsed.exit_code) code = run(parsed.arguments);
    finish_stdout();
    return code;
  } catch (const limpid::Error& error) {
    if (error.fault() == limpid::Fault::kMemory) end_out_of_memory(error.what());
    print_error(error.what());
    return exit_code_of(error.fault());
  } catch (const std::bad_alloc&) {
    end_out_of_memory(limpid::no_memory().what());
  } catch (const std::system_error& error) {
    // No thread can be made, because its stack needs memory, too.
    if (error.code() != std::errc::resource_unavailable_try_again) {
      print_error(error.what());
      return 1;
    }
    if (is_memory_limited()) end_out_of_memory(limpid::no_memory().what());
    print_error(std::string("cannot start a thread (") + error.what() + ")");
    return exit_code_of(limpid::Fault::kRetry);
  } catch (const std::exception& error) {
    print_error(error.what());
    return 1;
  }
}
