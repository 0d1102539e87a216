#include "arguments.h"

#include <iostream>
#include <utility>

#include <CLI/CLI.hpp>

#include "limpid/core/error.h"
#include "limpid/version.h"

#include "completion.h"
#include "declare_verbs.h"
#include "option_range.h"

namespace limpid::tool {
namespace {

constexpr int kWrongUsage = 2;

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The error about the first unexpected word.
std::string unexpected(const CLI::App& app) {
  const std::vector<std::string> rest = app.remaining(true);
  const std::string word = rest.empty() ? "" : rest.front().substr(0, rest.front().find('='));
  const bool is_option = word.starts_with('-');
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  if (parsed.empty() && !is_option) {
    const std::vector<std::string> verbs = verbs_of(app);
    return "'" + word + "' is not a verb: expected one of " + join(verbs) +
           did_you_mean(word, verbs);
  }
  const std::string verb = parsed.empty() ? "" : " " + parsed.front()->get_name();
  if (!is_option) return "limpid" + verb + ": unexpected argument '" + word + "'";
  std::vector<std::string> known = options_of(app);
  if (!parsed.empty()) {
    for (const std::string& name : options_of(*parsed.front())) known.push_back(name);
  }
  return "limpid" + verb + " has no option '" + word + "': limpid help" + verb +
         " lists its options" + did_you_mean(word, known);
}

std::string sentence_of(const CLI::ParseError& error, const CLI::App& app) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) return unexpected(app);
  std::string text = error.what();
  if (dynamic_cast<const CLI::ValidationError*>(&error)) {
    return text.erase(text.find(": "), 1);  // "--fps: 0: expected ..."
  }
  constexpr std::string_view kNoNumber = "Could not convert: ";
  if (text.starts_with(kNoNumber)) return text.substr(kNoNumber.size()) + ": expected a number";
  return text;
}

/// A sentence about the first option of the verb with an empty word; "" if there is none.
std::string empty_word(const CLI::App& app) {
  for (const CLI::App* verb : app.get_subcommands()) {
    for (const CLI::Option* option : verb->get_options()) {
      for (const std::string& word : option->results()) {
        if (word.empty()) return option->get_name() + " '': expected " + option->get_option_text();
      }
    }
  }
  return "";
}

/// The index of `--` in `limpid farm ... --`, else the end: another command line follows.
int end_of_own_words(int argc, char** argv) {
  int at = 1;
  while (at < argc && argv[at][0] == '-') ++at;
  if (at == argc || std::string_view(argv[at]) != "farm") return argc;
  while (at < argc && std::string_view(argv[at]) != "--") ++at;
  return at;
}

constexpr std::pair<std::string_view, Verb> kVerbs[] = {
    {"composite", Verb::kComposite}, {"plan", Verb::kPlan},     {"view", Verb::kView},
    {"render", Verb::kRender},       {"water", Verb::kWater},   {"truth", Verb::kTruth},
    {"inspect", Verb::kInspect},     {"looks", Verb::kLooks},   {"operators", Verb::kOperators},
    {"compare", Verb::kCompare},     {"report", Verb::kReport}, {"shader", Verb::kShader},
    {"farm", Verb::kFarm},
};

Verb verb_named(std::string_view name) {
  for (const auto& [word, verb] : kVerbs) {
    if (word == name) return verb;
  }
  return Verb::kNone;
}

}  // namespace

Parsed parse(int argc, char** argv) {
  Parsed parsed;
  Arguments& a = parsed.arguments;
  CLI::App app{"limpid puts water into pictures that were rendered without it.", "limpid"};
  app.set_version_flag("--version", std::string("limpid ") + kVersion);
  app.require_subcommand(0, 1);
  app.fallthrough();
  app.set_help_all_flag("--help-all", "Help of all verbs");
  app.add_option("--threads", a.common.threads, "Threads (default: 0, one per core)")
      ->option_text("N")
      ->check(whole_number_in(0, 1024));
  app.add_option("--max-memory", a.common.max_memory,
                 "Memory limit, from 16M up; a job or file that needs more is refused (default: 8G "
                 "per file)")
      ->option_text("SIZE");
  app.add_flag("-q", a.common.quiet, "Print errors only");
  app.add_flag("-v", a.common.verbose, "Also print the plan and the source of each buffer");
  app.footer("Exit codes: 0 done, 1 failed, 2 wrong usage, 75 temporary failure: try again.");

  declare_verbs(app, a);
  const int own_words = end_of_own_words(argc, argv);
  for (int i = own_words + 1; i < argc; ++i) a.farm.command.emplace_back(argv[i]);

  std::string shell;
  CLI::App& completion =
      *app.add_subcommand("completion", "Print the completion script of a shell");
  completion.add_option("shell", shell, "bash, zsh or fish")
      ->option_text("bash|zsh|fish")
      ->required();

  std::string help_verb;
  CLI::App& help = *app.add_subcommand("help", "Help of a verb, or of an operator");
  help.add_option("verb", help_verb, "Verb or operator")->option_text("VERB");

  const auto finish = [&](int code) {
    parsed.exit_code = code;
    return parsed;
  };
  try {
    app.parse(own_words, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      app.exit(error, std::cout, std::cout);
      return finish(0);
    }
    std::cerr << "limpid ERROR: " << sentence_of(error, app) << "\n";
    return finish(kWrongUsage);
  }
  if (const std::string fault = empty_word(app); !fault.empty()) {
    std::cerr << "limpid ERROR: " << fault << "\n";
    return finish(kWrongUsage);
  }
  if (completion.parsed()) {
    std::cout << completion_script(app, shell);
    return finish(0);
  }
  if (help.parsed() && !help_verb.empty()) {
    for (const CLI::App* verb : app.get_subcommands({})) {
      if (verb->get_name() != help_verb) continue;
      std::cout << verb->help("limpid");
      return finish(0);
    }
    a.verb = Verb::kOperators;
    a.operators.name = help_verb;
    a.operators.verbs = verbs_of(app);
    return parsed;
  }
  if (help.parsed() || app.get_subcommands().empty()) {
    // App::help() would give the help of the verb, which is `help`.
    std::cout << app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal);
    return finish(help.parsed() ? 0 : kWrongUsage);
  }
  a.verb = verb_named(app.get_subcommands().front()->get_name());
  if (a.verb == Verb::kComposite && a.composite.water.dry_run) a.verb = Verb::kPlan;
  return parsed;
}

}  // namespace limpid::tool
