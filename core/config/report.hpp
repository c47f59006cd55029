#pragma once

#include <string>
#include <vector>

#include "core/config/declared_key.hpp"
#include "core/config/node.hpp"

namespace drift::config {

/// A value of the resolved configuration: where it stands, what it is, where it came from.
struct ResolvedValue {
  std::string key;
  std::string text;
  std::string origin;  ///< "study.toml:12", "--set", both ("study.toml:12 and --set"), "default",
                       ///< "default prior"
};

/// Whether a report keeps what keys were asked for.
enum class Declared { dropped, kept };

/// Collects what reading a file brings to light: every mistake, and every value that holds.
class Report {
 public:
  explicit Report(std::string path, Declared declared = Declared::dropped);

  /// `text` in the grammar "what is wrong (what is expected). What to do".
  void error(const Place& at, const std::string& text);
  void given(const std::string& key, const std::string& text, const Place& at);
  void assumed(const std::string& key, const std::string& text,
               const std::string& origin = "default");

  /// What a key takes. The first that is said of a key holds; of one that is unknown so far, the
  /// next.
  void declare(const DeclaredKey& key);
  /// The same of a key by its full path, where that was asked for before.
  void declare_at(std::string_view path, const DeclaredKey& key);
  void require(std::string_view section, std::string_view key);
  bool keeps_declared() const { return kept_ == Declared::kept; }
  const std::vector<DeclaredKey>& declared() const { return declared_; }

  std::size_t errors() const { return errors_.size(); }
  /// InputError (config) with all mistakes in the order of the file, if there is any.
  void throw_if_wrong() const;

  const std::vector<ResolvedValue>& resolved() const { return resolved_; }

 private:
  struct Error {
    Place at;
    std::string message;
  };
  std::string path_;
  std::string file_name_;
  std::vector<Error> errors_;
  std::vector<ResolvedValue> resolved_;
  Declared kept_;
  std::vector<DeclaredKey> declared_;
};

}  // namespace drift::config
