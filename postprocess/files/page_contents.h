#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace postprocess
{
  /** A file that the scene of a page names. */
  struct AttachedFile
  {
    std::string                entry;   ///< that names it, "Specimen/File"
    std::string                named;   ///< what the scene calls it
    std::uint64_t              digest;  ///< of its content
    std::optional<std::string> content; ///< nothing: it was too long for the page
  };

  /** Whether a file's content is a page written by HtmlPage. */
  bool is_page_text(const std::string &content);

  /** What a page written by HtmlPage can be run from. */
  struct PageContents
  {
    std::string               scene;
    std::vector<AttachedFile> files;
  };

  /**
   * @param origin for messages
   * @throws base::InputError where there is no scene in the page, and for a file in it whose content is not what it was
   */
  PageContents read_page_contents(const std::string &page, const std::string &origin);

  /** Bytes of a text of 64 letters (RFC 4648); nothing where it is none. */
  std::optional<std::string> bytes_of_base64(const std::string &text);

  // What stands around them in a page.
  inline constexpr const char *page_opening       = "<!DOCTYPE html>";
  inline constexpr const char *scene_opening      = "<pre id=\"scene\">";
  inline constexpr const char *scene_closing      = "</pre>";
  inline constexpr const char *attachment_opening = "<script type=\"application/octet-stream\" data-entry=\"";
  inline constexpr const char *attachment_closing = "</script>";
} // namespace postprocess
