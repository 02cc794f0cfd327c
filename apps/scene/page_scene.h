#pragma once

#include "apps/scene/assignment.h"
#include "postprocess/files/page_contents.h"

#include <string>
#include <vector>

namespace apps
{
  /** Whether a scene's file is a page of a run, report.html. */
  bool is_page(const std::string &file);

  /**
   * Give the entries that name files those that the page holds, written beside it into the folder PAGE_files; a file that was too long for
   * the page must lie where the scene says.
   * @throws base::InputError where a file is not what it was; postprocess::OutputError
   */
  void use_files_of_page(const postprocess::PageContents &page,
                         const std::string               &file,
                         std::vector<Assignment>         &assignments);
} // namespace apps
