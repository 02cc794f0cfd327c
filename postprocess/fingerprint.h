#pragma once

#include <cstdint>
#include <string_view>

namespace postprocess
{
  /** Of a file or an array, 64 bits: tells an accident, not an enemy (FNV-1a). */
  class Fingerprint
  {
  public:
    Fingerprint &add(const std::string_view bytes)
    {
      for (const char byte : bytes)
        sum = (sum ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
      return *this;
    }
    std::uint64_t value() const { return sum; }

  private:
    std::uint64_t sum = 0xcbf29ce484222325u;
  };
} // namespace postprocess
