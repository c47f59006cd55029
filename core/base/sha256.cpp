#include "core/base/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/base/check.hpp"
#include "core/base/file_text.hpp"

namespace drift {

struct Sha256::Context {
  EVP_MD_CTX* md = EVP_MD_CTX_new();
  Context() {
    if (md == nullptr || EVP_DigestInit_ex(md, EVP_sha256(), nullptr) != 1)
      throw ContractError("libcrypto gives no SHA-256");
  }
  ~Context() { EVP_MD_CTX_free(md); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
};

Sha256::Sha256() : context_(std::make_unique<Context>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&&) noexcept = default;
Sha256& Sha256::operator=(Sha256&&) noexcept = default;

void Sha256::update(std::string_view bytes) {
  if (EVP_DigestUpdate(context_->md, bytes.data(), bytes.size()) != 1)
    throw ContractError("libcrypto: SHA-256 failed");
}

void Sha256::update(std::span<const double> values) {
  update(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
}

std::string Sha256::finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (EVP_DigestFinal_ex(context_->md, digest.data(), &size) != 1)
    throw ContractError("libcrypto: SHA-256 failed");
  return {reinterpret_cast<const char*>(digest.data()), size};
}

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.update(bytes);
  return hash.finish();
}

std::string to_hex(std::string_view bytes) {
  constexpr char hex[] = "0123456789abcdef";
  std::string out;
  out.reserve(2 * bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    out += hex[byte >> 4];
    out += hex[byte & 15];
  }
  return out;
}

std::string sha256_hex(std::string_view bytes) {
  return to_hex(sha256(bytes));
}

std::string sha256_hex_of_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && (errno == ENOENT || errno == ENOTDIR)) return {};
  if (!file) throw_cannot_read(path, std::strerror(errno));
  Sha256 hash;
  std::string part(1 << 16, '\0');
  while (file) {
    errno = 0;
    file.read(part.data(), static_cast<std::streamsize>(part.size()));
    if (file.bad()) throw_cannot_read(path, std::strerror(errno != 0 ? errno : EIO));
    hash.update(std::string_view(part).substr(0, static_cast<std::size_t>(file.gcount())));
  }
  return to_hex(hash.finish());
}

}  // namespace drift
