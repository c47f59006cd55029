#include "core/config/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/base/check.hpp"
#include "core/base/utf8.hpp"

namespace drift::config {

Report::Report(std::string path, Declared declared)
    : path_(std::move(path)),
      file_name_(utf8_text(path_.substr(path_.find_last_of('/') + 1))),
      kept_(declared) {}

void Report::declare(const DeclaredKey& key) {
  if (!keeps_declared()) return;
  for (DeclaredKey& known : declared_) {
    if (known.section != key.section || known.key != key.key) continue;
    const bool required = known.required || key.required;
    if (known.kind == DeclaredKey::Kind::unknown) known = key;
    known.required = required;
    return;
  }
  declared_.push_back(key);
}

void Report::declare_at(std::string_view path, const DeclaredKey& key) {
  if (!keeps_declared()) return;
  for (const DeclaredKey& known : declared_) {
    const std::string full = known.section.empty() ? known.key : known.section + "." + known.key;
    if (full != path) continue;
    DeclaredKey named = key;
    named.section = known.section;
    named.key = known.key;
    return declare(named);
  }
}

void Report::require(std::string_view section, std::string_view key) {
  if (!keeps_declared()) return;
  declare({std::string(section), std::string(key)});
  for (DeclaredKey& known : declared_)
    if (known.section == section && known.key == key) known.required = true;
}

void Report::error(const Place& at, const std::string& what) {
  // The names that a file gives end no line; a line that is ours is indented.
  constexpr std::string_view ours = "\n    ";
  std::string text;
  std::size_t from = 0;
  for (std::size_t at_end; (at_end = what.find(ours, from)) != std::string::npos;
       from = at_end + ours.size())
    text += text_of_name(what.substr(from, at_end - from)).append(ours);
  text += text_of_name(what.substr(from));
  errors_.push_back({at, at.set_key.empty()
                             ? fmt::format("{}:{}:{}: {}", path_, at.line, at.column, text)
                             : fmt::format("--set {}: {}", at.set_key, text)});
}

void Report::given(const std::string& key, const std::string& text, const Place& at) {
  resolved_.push_back({key, text,
                       at.set_key.empty() ? fmt::format("{}:{}{}", file_name_, at.line,
                                                        at.added_to ? " and --set" : "")
                                          : "--set"});
}

void Report::assumed(const std::string& key, const std::string& text, const std::string& origin) {
  resolved_.push_back({key, text, origin});
}

void Report::throw_if_wrong() const {
  if (errors_.empty()) return;
  constexpr std::size_t most = 1000;  // a file of another kind has no end of them
  std::vector<Error> sorted = errors_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Error& a, const Error& b) {
    return std::make_tuple(!a.at.set_key.empty(), a.at.line, a.at.column) <
           std::make_tuple(!b.at.set_key.empty(), b.at.line, b.at.column);
  });
  std::vector<std::string> messages;
  for (const auto& error : sorted) {
    if (messages.size() == most) break;
    messages.push_back(error.message);
  }
  if (sorted.size() > most)
    messages.push_back(
        fmt::format("{}:1:1: {} more errors (expected a study file). Check that this "
                    "is one",
                    path_, sorted.size() - most));
  throw InputError(ExitCode::config, messages);
}

}  // namespace drift::config
