#include "completion.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>

#include "limpid/core/error.h"

namespace limpid::tool {
namespace {

/// The words among the alternatives of an option's value, as in "all|NAME,...": those in lower
/// case.
std::vector<std::string> words_of(const CLI::Option& option) {
  std::vector<std::string> words;
  std::istringstream text(option.get_option_text());
  for (std::string word; std::getline(text, word, '|');) {
    const bool plain = std::all_of(word.begin(), word.end(), [](unsigned char c) {
      return std::islower(c) || std::isdigit(c) || c == '-' || c == '_';
    });
    if (plain && !word.empty()) words.push_back(word);
  }
  return words;
}

bool takes_value(const CLI::Option& option) { return option.get_expected_max() > 0; }

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : names_of(*option)) names.push_back(name);
  }
  return names;
}

/// Calls the function for each named option with a value, with the words for it.
template <class Body>
void for_each_value(const CLI::App& app, const Body& body) {
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string> names = names_of(*option);
    if (!names.empty() && takes_value(*option)) body(join(names, "|"), words_of(*option));
  }
}

std::string verb_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands({})) names.push_back(verb->get_name());
  return join(names, " ");
}

/// Without words the shell completes names of files.
std::string bash_script(const CLI::App& app) {
  std::ostringstream out;
  out << "_limpid() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb= words= "
         "i\n"
         "  local verbs='"
      << verb_names(app)
      << "'\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    [[ \" $verbs \" == *\" ${COMP_WORDS[i]} \"* ]] && verb=${COMP_WORDS[i]} && break\n"
         "  done\n"
         "  case $verb:$before in\n";
  const auto values = [&](const std::string& verb, const CLI::App& of) {
    for_each_value(of, [&](const std::string& names, const std::vector<std::string>& words) {
      std::istringstream each(names);
      std::vector<std::string> patterns;
      for (std::string name; std::getline(each, name, '|');) patterns.push_back(verb + ":" + name);
      out << "    " << join(patterns, "|") << ") words='" << join(words, " ") << "' ;;\n";
    });
  };
  for (const CLI::App* verb : app.get_subcommands({})) values(verb->get_name(), *verb);
  values("*", app);
  out << "    help:help) words=$verbs ;;\n    completion:completion) words='bash zsh fish' ;;\n";
  for (const CLI::App* verb : app.get_subcommands({})) {
    out << "    " << verb->get_name() << ":*) [[ $word == -* ]] && words='"
        << join(names_of(*verb), " ") << " " << join(names_of(app), " ") << "' ;;\n";
  }
  out << "    :*) words=\"$verbs " << join(names_of(app), " ")
      << "\" ;;\n"
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "}\n"
         "complete -o default -F _limpid limpid\n";
  return out.str();
}

std::string fish_word(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return quoted + "'";
}

std::string fish_script(const CLI::App& app) {
  std::ostringstream out;
  const auto options = [&](const CLI::App& of, const std::string& when) {
    for (const CLI::Option* option : of.get_options()) {
      if (names_of(*option).empty()) continue;
      out << "complete -c limpid" << when;
      for (const std::string& name : option->get_snames()) {
        out << (name.size() == 1 ? " -s " : " -o ") << name;
      }
      for (const std::string& name : option->get_lnames()) out << " -l " << name;
      if (takes_value(*option)) out << " -r";
      const std::vector<std::string> words = words_of(*option);
      if (!words.empty()) out << " -a " << fish_word(join(words, " "));
      out << " -d " << fish_word(option->get_description()) << "\n";
    }
  };
  options(app, "");
  for (const CLI::App* verb : app.get_subcommands({})) {
    out << "complete -c limpid -n __fish_use_subcommand -a " << verb->get_name() << " -d "
        << fish_word(verb->get_description()) << "\n";
    options(*verb, " -n '__fish_seen_subcommand_from " + verb->get_name() + "'");
  }
  out << "complete -c limpid -f -n '__fish_seen_subcommand_from help' -a "
      << fish_word(verb_names(app))
      << "\ncomplete -c limpid -f -n '__fish_seen_subcommand_from completion' -a 'bash zsh fish'\n";
  return out.str();
}

}  // namespace

std::string completion_script(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash_script(app);
  if (shell == "zsh") return "autoload -U +X bashcompinit && bashcompinit\n" + bash_script(app);
  if (shell == "fish") return fish_script(app);
  throw Error("completion '" + shell + "': expected bash, zsh or fish", Fault::kUsage);
}

}  // namespace limpid::tool
