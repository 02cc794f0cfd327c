#include "postprocess/files/digest.h"

#include "base/errors.h"
#include "postprocess/files/file_descriptor.h"

#include <array>
#include <fstream>

namespace postprocess
{
  std::uint64_t digest_of_file(const std::filesystem::path &file)
  {
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
      throw base::InputError(file.string() + ": cannot be read: " + system_reason() + ".");
    Digest                  digest;
    std::array<char, 65536> block;
    while (stream.read(block.data(), block.size()) || stream.gcount() > 0)
      digest.add({block.data(), static_cast<std::size_t>(stream.gcount())});
    if (stream.bad())
      throw base::InputError(file.string() + ": cannot be read to its end: " + system_reason() + ".");
    return digest.value();
  }
} // namespace postprocess
