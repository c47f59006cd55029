#include "analysis/cli/shell/not_known.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include "analysis/cli/argument_checks.hpp"

namespace drift::cli {

std::string not_known(const CLI::App& app, int argc, char** argv) {
  const CLI::App* chosen = nullptr;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (chosen == nullptr && !word.starts_with('-')) {
      std::vector<std::string> names;
      for (const CLI::App* c : app.get_subcommands(nullptr)) {
        names.push_back(c->get_name());
        if (c->get_name() == word) chosen = c;
      }
      if (chosen == nullptr)
        return unknown("command", word, std::vector<std::string_view>(names.begin(), names.end()));
    } else if (word.starts_with("--") && word.size() > 2) {
      const std::string given = word.substr(0, word.find('='));
      std::vector<std::string> names;
      bool takes_next = false;
      for (const CLI::Option* o : (chosen != nullptr ? *chosen : app).get_options(nullptr))
        for (const std::string& name : o->get_lnames()) {
          names.push_back("--" + name);
          if (names.back() == word) takes_next = o->get_items_expected_min() > 0;
        }
      if (std::find(names.begin(), names.end(), given) == names.end())
        return unknown("option", given, std::vector<std::string_view>(names.begin(), names.end()));
      if (takes_next) ++i;  // its value, and no command
    }
  }
  return {};
}

}  // namespace drift::cli
