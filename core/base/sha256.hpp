#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace drift {

/// SHA-256 of what is fed to it, piece by piece (OpenSSL libcrypto).
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&&) noexcept;
  Sha256& operator=(Sha256&&) noexcept;

  void update(std::string_view bytes);
  void update(std::span<const double> values);  ///< their bytes as they are in memory
  /// The digest of all so far, 32 bytes; nothing can be added after it.
  std::string finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// SHA-256 of a text, 32 bytes.
std::string sha256(std::string_view bytes);
/// Bytes in hexadecimal, lower case.
std::string to_hex(std::string_view bytes);
/// SHA-256 of a text as 64 hexadecimal digits.
std::string sha256_hex(std::string_view bytes);
/// The same of a file; empty if there is none. InputError (io) if it cannot be read.
std::string sha256_hex_of_file(const std::string& path);

}  // namespace drift
