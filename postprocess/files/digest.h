#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace postprocess
{
  /**
   * A number by which changed content is noticed: FNV-1a of 64 bits (Fowler, Noll and Vo; RFC 9923). Chance equality of two
   * contents has a probability of 5e-20; it is no protection against intent.
   */
  class Digest
  {
  public:
    Digest &add(const std::string_view bytes)
    {
      for (const char c : bytes)
        value_now = (value_now ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
      return *this;
    }

    std::uint64_t value() const { return value_now; }

  private:
    std::uint64_t value_now = 0xcbf29ce484222325ULL;
  };

  /** Of all bytes of a file. @throws base::InputError if it cannot be read. */
  std::uint64_t digest_of_file(const std::filesystem::path &file);
} // namespace postprocess
