#include "hooke/io/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <cstdint>

#include "hooke/core/error.h"

namespace hooke {

std::string sha256(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) != 1)
    throw Error("SHA-256 failed in OpenSSL; expected a digest; check the installation of OpenSSL");
  std::string hex;
  for (unsigned i = 0; i < size; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

std::string connectivity_sha256(const std::vector<Triangle>& faces) {
  std::string bytes(12 * faces.size(), 0);
  char* at = bytes.data();
  for (const Triangle& t : faces)
    for (int v : t)
      for (int shift = 0; shift < 32; shift += 8)
        *at++ = static_cast<char>(static_cast<std::uint32_t>(v) >> shift & 0xff);
  return sha256(bytes);
}

}  // namespace hooke
