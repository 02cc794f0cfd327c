#include "postprocess/files/scratch_folder.h"

#include "postprocess/files/errors.h"
#include "postprocess/files/file_descriptor.h"

#include <fcntl.h>
#include <stdlib.h>

#include <system_error>

namespace postprocess
{
  ScratchFolder::ScratchFolder(const std::string &purpose)
  {
    std::error_code             failed;
    const std::filesystem::path temporary = std::filesystem::temp_directory_path(failed);
    if (failed)
      throw OutputError("no folder for temporary files (TMPDIR): " + failed.message());
    std::string pattern = (temporary / ("breccia-" + purpose + "-XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr)
      throw OutputError(pattern + ": the folder cannot be made: " + system_reason() + ".");
    folder = pattern;
  }

  ScratchFolder::~ScratchFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  void ScratchFolder::write(const std::string &name, const std::string &text) const
  {
    FileDescriptor(folder / name, O_WRONLY | O_CREAT | O_EXCL).write(text);
  }
} // namespace postprocess
