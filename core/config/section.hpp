#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/linalg.hpp"
#include "core/base/named.hpp"
#include "core/config/option.hpp"
#include "core/config/quantity.hpp"
#include "core/config/report.hpp"

namespace drift::config {

/// Strict reader of one table. Every key the program knows is asked for once, present or not;
/// finish() then reports the keys nobody asked for. Mistakes go to the Report and leave the value
/// as it was, so that all mistakes of a file are found in one reading.
class Section {
 public:
  using Kind = DeclaredKey::Kind;

  /// `table` may be null (the section is absent) or no table (reported). `path` is its dotted key.
  Section(Report& report, const Node* table, Place at, std::string path);

  bool present() const { return table_ != nullptr; }
  const Place& at() const { return at_; }
  /// What the resolved list says of values that are not given here: "default" unless said
  /// otherwise.
  void defaults_come_from(std::string origin) { origin_ = std::move(origin); }
  Report& report() const { return *report_; }
  std::string full(std::string_view key) const;

  /// The value of a key, which thereby is known; null if absent.
  const Node* take(std::string_view key);
  /// The same, saying what the key takes to a report that keeps it: the reads below do.
  const Node* take(std::string_view key, Kind kind, const std::string& expected);
  /// Says that a key, read as a text, takes one of these names.
  void choices(std::string_view key, std::span<const std::string_view> names);
  bool has(std::string_view key) const;

  /// Each reads one key into `value` (a quantity: in SI) if it is present and right; the resolved
  /// list then has it as given, or the present `value` as default. True if given and right.
  bool read(const Option& option, double& value);
  bool read(const Option& option, std::optional<double>& value);
  bool read(const Option& option, Vec3& value);  ///< a list of three
  bool read(const Option& option, Mat3& value);  ///< a list of three rows
  bool read(const Option& option, bool& value);
  bool read(const Option& option, std::string& value);    ///< one line, max <= 200 characters
  bool read(const Option& option, std::uint64_t& value);  ///< a TOML integer or "0x..."
  bool read(const Option& option, int& value);
  /// One of the names of a table (named.hpp).
  template <class E, class Row, std::size_t N>
  bool read(const Option& option, E& value, const Row (&choices)[N]);

  /// Reports the key as missing if it is. `example` is how it may look: `latitude = "45.75 deg"`.
  bool require(std::string_view key, std::string_view example);

  Section section(std::string_view key);
  /// The elements of [[key]]; each is called path.name, or path.number where it has no name.
  std::vector<Section> sections(std::string_view key);

  /// Reads all fields of an options struct.
  template <Options T>
  void read_options(T& options) {
    visit_options(options, [&](const Option& option, auto& value) { read(option, value); });
  }

  /// Reports every key that was not asked for, with the nearest that is known.
  void finish();

 private:
  std::optional<std::size_t> choose(const Option& option, std::span<const std::string_view> names);
  void wrong(const Node& node, std::string_view key, const std::string& expected,
             const std::string& fix);
  bool read_whole(const Option& option, std::uint64_t& value);
  const Node* take_number(const Option& option);

  Report* report_;
  const Node* table_;
  Place at_;
  std::string path_;
  std::vector<std::string> known_;
  std::string origin_ = "default";
};

template <class E, class Row, std::size_t N>
bool Section::read(const Option& option, E& value, const Row (&choices)[N]) {
  std::vector<std::string_view> names;
  for (const Row& choice : choices) names.push_back(choice.name);
  if (const auto chosen = choose(option, names)) {
    value = choices[*chosen].value;
    return true;
  }
  if (!has(option.key))
    report_->assumed(full(option.key), std::string(name_in(choices, value)), origin_);
  return false;
}

}  // namespace drift::config
