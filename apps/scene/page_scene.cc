#include "apps/scene/page_scene.h"

#include "base/errors.h"
#include "postprocess/files/atomic_file.h"
#include "postprocess/files/digest.h"

#include <filesystem>

namespace apps
{
  namespace fs = std::filesystem;

  namespace
  {
    void require_content(const fs::path &file, const postprocess::AttachedFile &wanted, const std::string &page)
    {
      if (!fs::is_regular_file(file))
        throw base::InputError(page + ": " + wanted.entry + " is not in the page: put the file at " +
                               file.string() + ".");
      if (postprocess::digest_of_file(file) != wanted.digest)
        throw base::InputError(page + ": " + wanted.entry + ": " + file.string() +
                               " is not the file that the run of this page read.");
    }

    /** Where the file lies now: written unless it does already. */
    fs::path unpacked(const postprocess::AttachedFile &attached, const std::size_t number, const std::string &page)
    {
      if (!attached.content)
        {
          require_content(attached.named, attached, page);
          return attached.named;
        }
      const fs::path folder =
        fs::absolute(fs::path(page).parent_path() / (fs::path(page).stem().string() + "_files")).lexically_normal();
      fs::path file = folder / (std::to_string(number) + "_" + fs::path(attached.named).filename().string());
      if (postprocess::is_page_text(*attached.content)) // a scene that has files of its own
        file.replace_extension(".html");
      fs::create_directories(folder);
      if (fs::exists(file))
        require_content(file, attached, page);
      else
        postprocess::write_text(file, *attached.content);
      return file;
    }
  } // namespace

  bool is_page(const std::string &file) { return fs::path(file).extension() == ".html"; }

  void use_files_of_page(const postprocess::PageContents &page,
                         const std::string               &file,
                         std::vector<Assignment>         &assignments)
  {
    for (std::size_t k = 0; k < page.files.size(); ++k)
      {
        const postprocess::AttachedFile &attached = page.files[k];
        const std::string                now      = unpacked(attached, k + 1, file).string();
        for (Assignment &assignment : assignments)
          if (assignment.path() == attached.entry)
            if (const std::size_t at = assignment.value.find(attached.named); at != std::string::npos)
              assignment.value.replace(at, attached.named.size(), now);
      }
  }
} // namespace apps
