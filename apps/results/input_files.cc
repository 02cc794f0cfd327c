#include "apps/results/input_files.h"

#include "base/errors.h"

#include <fmt/format.h>

#include <sstream>

namespace apps
{
  namespace
  {
    /** A line of a list: content, and what it is the content of. */
    struct ListedFile
    {
      std::uintmax_t bytes;
      std::uint64_t  digest;
      std::string    name;

      std::string text() const { return fmt::format("{} {:016x} {}\n", bytes, digest, name); }
    };

    std::vector<ListedFile> lines_of(const std::string &list)
    {
      std::vector<ListedFile> lines;
      std::istringstream      text(list);
      for (ListedFile line; text >> std::dec >> line.bytes >> std::hex >> line.digest;)
        {
          text.ignore(1);
          std::getline(text, line.name);
          lines.push_back(line);
        }
      return lines;
    }
  } // namespace

  std::string listed(const std::vector<InputFile> &inputs)
  {
    std::string text;
    for (const InputFile &input : inputs)
      text += ListedFile{input.bytes, input.digest, input.entry}.text();
    return text;
  }

  void require_same_content(const std::vector<InputFile> &inputs, const std::string &list)
  {
    const std::vector<ListedFile> before = lines_of(list);
    for (std::size_t i = 0; i < inputs.size() && i < before.size(); ++i)
      if (inputs[i].bytes != before[i].bytes || inputs[i].digest != before[i].digest)
        throw base::InputError(
          fmt::format("{} = {}: the file is not what it was when the interrupted run began ({} "
                      "bytes then, {} now). Put it back as it was, or start afresh with --restart.",
                      inputs[i].entry, inputs[i].file, before[i].bytes, inputs[i].bytes));
  }
} // namespace apps
