#include "welkin/app/checksum.h"

#include <fmt/format.h>
#include <sodium.h>

#include <fstream>
#include <vector>

#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {

std::string hex(const unsigned char (&digest)[crypto_hash_sha256_BYTES]) {
  char text[2 * crypto_hash_sha256_BYTES + 1];
  return sodium_bin2hex(text, sizeof text, digest, sizeof digest);
}

}  // namespace

std::string sha256(std::string_view bytes) {
  unsigned char digest[crypto_hash_sha256_BYTES];
  crypto_hash_sha256(digest, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  return hex(digest);
}

Result<std::string> sha256File(const std::filesystem::path& file) {
  std::error_code ec;
  std::ifstream in;
  if (!std::filesystem::is_directory(file, ec)) in.open(file, std::ios::binary);
  if (!in.is_open()) return Error{fmt::format("{}: cannot be read", file.string())};
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  std::vector<char> block(1 << 20);
  while (in) {
    in.read(block.data(), std::streamsize(block.size()));
    crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(block.data()), static_cast<unsigned long long>(in.gcount()));
  }
  if (in.bad()) return Error{fmt::format("{}: cannot be read", file.string())};
  unsigned char digest[crypto_hash_sha256_BYTES];
  crypto_hash_sha256_final(&state, digest);
  return hex(digest);
}

std::map<std::filesystem::path, std::string> dataChecksums(const Scene& scene) {
  std::map<std::filesystem::path, std::string> out;
  for (const auto& file : dataFiles(scene)) {
    const auto sum = sha256File(file);
    out[file] = sum ? *sum : kMissing;
  }
  return out;
}

}  // namespace welkin::app
