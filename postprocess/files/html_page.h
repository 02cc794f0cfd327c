#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /**
   * A page for a browser that is one file: pictures stand in its text, and nothing is loaded from elsewhere. What it can be run from
   * again stands in it too; read_page_contents() takes that out.
   */
  class HtmlPage
  {
  public:
    static constexpr std::size_t largest =
      2'000'000; ///< [byte], so that it can be sent; pictures beyond are named, not shown

    explicit HtmlPage(const std::string &title);

    void heading(const std::string &text);
    void paragraph(const std::string &text);
    void list(const std::vector<std::string> &lines); ///< nothing where there is none
    void lines(const std::string &text);              ///< as they stand, in letters of one width
    /** The same, folded away until opened. */
    void folded(const std::string &summary, const std::string &lines);
    /** The first row names the columns; numbers are set to the right. */
    void table(const std::vector<std::vector<std::string>> &rows);
    /** A PNG file; nothing where there is none: a picture that could not be drawn costs no report. @throws base::InputError for one that cannot be read */
    void picture(const std::filesystem::path &file, const std::string &caption);

    /** The scene that it is about, folded away. */
    void scene(const std::string &text);
    /**
     * A file that the scene names, so that the page needs no other; only its name where it would take more than half of the page.
     * @param entry that names it, "Specimen/File" @param named what the scene calls it
     */
    void attach(const std::string &entry, const std::string &named, const std::filesystem::path &file);
    /** A file that must lie where it is named: its name and what it holds, not its content. */
    void require(const std::string &entry, const std::string &named, const std::filesystem::path &file);
    /** As attach(), for a page of the file named, with what that needs itself. @return false, and nothing done, where it would be too long */
    bool attach_page(const std::string &entry, const std::string &named, const std::string &page);

    /** The whole page. */
    std::string text() const;

  private:
    bool has_room_for(std::uintmax_t bytes) const;
    void
    add_attached(const std::string &entry, const std::string &named, std::uint64_t digest, const std::string &text);

    std::string title, body;
  };

  /** Bytes as text of 64 letters (RFC 4648). */
  std::string base64(const std::string &bytes);
} // namespace postprocess
