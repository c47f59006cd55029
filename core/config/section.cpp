#include "core/config/section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/config/nearest.hpp"

namespace drift::config {
namespace {

/// Among which keys the meant one is looked for: those still free, unless one that stands in the
/// file already is closer by a whole slip (--set of a misspelt key).
const std::vector<std::string_view>& likelier(std::string_view typed,
                                              const std::vector<std::string_view>& free,
                                              const std::vector<std::string_view>& all) {
  const auto best_free = nearest(typed, free), best = nearest(typed, all);
  if (best_free.empty()) return all;
  return typing_distance(typed, best.front()) + 0.95 < typing_distance(typed, best_free.front())
             ? all
             : free;
}

/// A name as a part of a dotted key that --set takes: in quotes where it has dots of its own.
std::string key_part(const std::string& name) {
  if (name.find('.') == std::string::npos) return name;
  const char quote = name.find('"') == std::string::npos ? '"' : '\'';
  return quote + name + quote;
}

/// Stands for a section that is no table, so that its keys are not reported as missing on top.
const Node no_table{};

}  // namespace

Section::Section(Report& report, const Node* table, Place at, std::string path)
    : report_(&report), table_(table), at_(std::move(at)), path_(std::move(path)) {
  if (table_ != nullptr && !table_->is(Node::Kind::table)) {
    report.error(table_->at,
                 fmt::format("'{}' is {} (expected {}). Write a table of keys and values", path_,
                             describe(*table_), expected_section(path_)));
    table_ = &no_table;
  }
  // One that was made of a node that take() gave.
  if (report.keeps_declared())
    report.declare_at(path_, {"", "", Kind::table, expected_section(path_)});
}

std::string Section::full(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool Section::has(std::string_view key) const {
  return table_ != nullptr && table_->find(key) != nullptr;
}

const Node* Section::take(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
    known_.emplace_back(key);
    if (report_->keeps_declared()) report_->declare({path_, std::string(key)});
  }
  return table_ == nullptr ? nullptr : table_->find(key);
}

const Node* Section::take(std::string_view key, Kind kind, const std::string& expected) {
  const Node* node = take(key);
  if (report_->keeps_declared()) report_->declare({path_, std::string(key), kind, expected});
  return node;
}

const Node* Section::take_number(const Option& option) {
  const Node* node = take(option.key);
  if (report_->keeps_declared())
    report_->declare(declared_number(path_, std::string(option.key), option));
  return node;
}

void Section::choices(std::string_view key, std::span<const std::string_view> names) {
  take(key);
  if (report_->keeps_declared())
    report_->declare(declared_choice(path_, std::string(key),
                                     std::vector<std::string>(names.begin(), names.end())));
}

void Section::wrong(const Node& node, std::string_view key, const std::string& expected,
                    const std::string& fix) {
  report_->error(node.at, fmt::format("'{}' is {} (expected {}). {}", full(key), describe(node),
                                      expected, fix));
}

bool Section::require(std::string_view key, std::string_view example) {
  take(key);  // known, present or not
  report_->require(path_, key);
  if (has(key) || table_ == &no_table) return true;
  report_->error(at_, fmt::format("'{}' is missing (expected {}). Add it{}", full(key), example,
                                  path_.empty() ? "" : fmt::format(" to [{}]", path_)));
  return false;
}

Section Section::section(std::string_view key) {
  const Node* node = take(key, Kind::section, expected_section(full(key)));
  return Section(*report_, node, node == nullptr ? at_ : node->at, full(key));
}

std::vector<Section> Section::sections(std::string_view key) {
  std::vector<Section> all;
  const std::string expected = expected_sections(full(key));
  const Node* node = take(key, Kind::sections, expected);
  if (node == nullptr) return all;
  if (!node->is(Node::Kind::array)) {
    wrong(*node, key, expected, fmt::format("Write [[{}]] with double brackets", full(key)));
    return all;
  }
  for (const auto& item : node->items) {
    const Node* name = item.find("name");
    const std::string called = name != nullptr && name->is(Node::Kind::string)
                                   ? name->text
                                   : fmt::format("{}", all.size());
    all.emplace_back(*report_, &item, item.at, fmt::format("{}.{}", full(key), key_part(called)));
  }
  return all;
}

void Section::finish() {
  if (table_ == nullptr) return;
  std::vector<std::string_view> free;  // a key that stands in the file already is hardly meant
  for (const auto& key : known_)
    if (table_->find(key) == nullptr) free.push_back(key);
  const std::vector<std::string_view> all(known_.begin(), known_.end());
  for (const auto& member : table_->members) {
    if (std::find(known_.begin(), known_.end(), member.key) != known_.end()) continue;
    const auto& candidates = likelier(member.key, free, all);
    report_->error(member.at,
                   fmt::format("unknown key '{}' (expected one of {}). {}", full(member.key),
                               fmt::join(all, ", "),
                               suggestion(member.key, candidates, "Remove it or correct it")));
  }
}

}  // namespace drift::config
