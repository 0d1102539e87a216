#include <cstdio>
#include <exception>
#include <new>

#include "limpid/core/error.h"

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

int run(const limpid::tool::Arguments& a) {
  using limpid::tool::Verb;
  switch (a.verb) {
    case Verb::kComposite:
      return composite_verb(a.composite, a.common);
    case Verb::kPlan:
      return plan_verb(a.composite);
    case Verb::kInspect:
      return inspect_verb(a.inspect);
    case Verb::kOperators:
      return operators_verb(a.operators);
    case Verb::kCompare:
      return compare_verb(a.compare);
    case Verb::kNone:
      break;
  }
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  const limpid::tool::Parsed parsed = limpid::tool::parse(argc, argv);
  if (parsed.exit_code) return *parsed.exit_code;
  try {
    return run(parsed.arguments);
  } catch (const limpid::Error& error) {
    std::fprintf(stderr, "limpid ERROR: %s\n", error.what());
    return exit_code_of(error.fault());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "limpid ERROR: out of memory\n");
    return 75;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "limpid ERROR: %s\n", error.what());
    return 1;
  }
}
