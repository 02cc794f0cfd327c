#pragma once

#include "apps/scene/section.h"
#include "postprocess/files/html_page.h"

namespace apps
{
  /**
   * Put into the page of a study or calibration what it can be run from again: its file, complete, and the files that it names. Scenes among
   * them stand there as pages of their own, with the files that they name, so that the page needs no other; of one that cannot, as it is too
   * long or refused without the study's changes, the page says that it must lie where it is named.
   *
   * @param root of the study's file
   */
  void add_to_repeat(postprocess::HtmlPage &page, const Section &root);
} // namespace apps
