#include "postprocess/files/html_page.h"

#include "postprocess/files/digest.h"
#include "postprocess/files/numeric_text.h"
#include "postprocess/files/page_contents.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>

namespace postprocess
{
  namespace
  {
    constexpr const char *style =
      "body{font:15px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
      "h1{font-size:1.5em}h2{font-size:1.15em;margin-top:1.6em}"
      "table{border-collapse:collapse;margin:1em 0;font-size:.9em}"
      "td,th{padding:.2em .7em;border-bottom:1px solid #ddd;text-align:left}td.n{text-align:right}"
      "img{max-width:100%}figure{margin:1em 0}figcaption{font-size:.9em;color:#555}"
      "pre{background:#f6f6f6;padding:.7em;overflow:auto;font-size:.85em}div{overflow:auto}";

    std::string escaped(const std::string &text)
    {
      std::string safe;
      for (const char c : text)
        safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : c == '"' ? "&quot;" : std::string(1, c);
      return safe;
    }

    bool looks_like_a_number(const std::string &cell)
    {
      return cell.find_first_of("0123456789") != std::string::npos &&
             cell.find_first_not_of("0123456789+-.e") == std::string::npos;
    }
  } // namespace

  HtmlPage::HtmlPage(const std::string &title_)
    : title(escaped(title_))
  {
  }

  void HtmlPage::heading(const std::string &text) { body += "<h2>" + escaped(text) + "</h2>\n"; }

  void HtmlPage::paragraph(const std::string &text) { body += "<p>" + escaped(text) + "</p>\n"; }

  void HtmlPage::list(const std::vector<std::string> &lines)
  {
    if (lines.empty())
      return;
    body += "<ul>\n";
    for (const std::string &line : lines)
      body += "<li>" + escaped(line) + "</li>\n";
    body += "</ul>\n";
  }

  void HtmlPage::lines(const std::string &text) { body += "<pre>" + escaped(text) + "</pre>\n"; }

  void HtmlPage::folded(const std::string &summary, const std::string &lines)
  {
    body += "<details><summary>" + escaped(summary) + "</summary>";
    this->lines(lines);
    body += "</details>\n";
  }

  void HtmlPage::table(const std::vector<std::vector<std::string>> &rows)
  {
    body += "<div><table>\n";
    for (std::size_t row = 0; row < rows.size(); ++row)
      {
        body += "<tr>";
        for (const std::string &cell : rows[row])
          if (row == 0)
            body += "<th>" + escaped(cell) + "</th>";
          else
            body += (looks_like_a_number(cell) ? "<td class=\"n\">" : "<td>") + escaped(cell) + "</td>";
        body += "</tr>\n";
      }
    body += "</table></div>\n";
  }

  void HtmlPage::picture(const std::filesystem::path &file, const std::string &caption)
  {
    if (!std::filesystem::exists(file))
      return;
    if (body.size() + std::filesystem::file_size(file) / 3 * 4 > largest * 9 / 10)
      return paragraph(file.filename().string() + " (" + caption + ") would make the page too long.");
    body += "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
            base64(numeric_text::read_whole(file)) + "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
  }

  void HtmlPage::scene(const std::string &text)
  {
    body += "<details><summary>scene.prm</summary>" + std::string(scene_opening) + escaped(text) + scene_closing +
            "</details>\n";
  }

  void HtmlPage::attach(const std::string &entry, const std::string &named, const std::filesystem::path &file)
  {
    const std::uintmax_t bytes = std::filesystem::file_size(file);
    const bool           fits  = has_room_for(bytes);
    add_attached(entry, named, digest_of_file(file), fits ? base64(numeric_text::read_whole(file)) : "");
    paragraph(entry + ": " + file.filename().string() + ", " + std::to_string(bytes) + " bytes, " +
              (fits ? "in this page." : "too long for this page."));
  }

  void HtmlPage::require(const std::string &entry, const std::string &named, const std::filesystem::path &file)
  {
    add_attached(entry, named, digest_of_file(file), "");
    paragraph(entry + ": " + file.filename().string() +
              " is not in this page: it must lie, with the files that it names, at " + named + ".");
  }

  bool HtmlPage::attach_page(const std::string &entry, const std::string &named, const std::string &page)
  {
    if (!has_room_for(page.size()))
      return false;
    add_attached(entry, named, Digest().add(page).value(), base64(page));
    paragraph(entry + ": " + std::filesystem::path(named).filename().string() + " with its files, in this page.");
    return true;
  }

  bool HtmlPage::has_room_for(const std::uintmax_t bytes) const { return body.size() + bytes / 3 * 4 < largest / 2; }

  void HtmlPage::add_attached(const std::string  &entry,
                              const std::string  &named,
                              const std::uint64_t digest,
                              const std::string  &text)
  {
    char number[17];
    std::snprintf(number, sizeof number, "%016" PRIx64, digest);
    body += attachment_opening + escaped(entry) + "\" data-named=\"" + escaped(named) + "\" data-digest=\"" + number +
            "\">" + text + attachment_closing + "\n";
  }

  std::string HtmlPage::text() const
  {
    return page_opening + std::string("\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>") + title +
           "</title><style>" + style + "</style></head>\n<body>\n<h1>" + title + "</h1>\n" + body + "</body></html>\n";
  }

  std::string base64(const std::string &bytes)
  {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string    text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3)
      {
        const std::size_t left = bytes.size() - at;
        std::uint32_t     bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
          bits = bits << 8 | (k < left ? static_cast<unsigned char>(bytes[at + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
          text += k <= left ? letters[bits >> (18 - 6 * k) & 63] : '=';
      }
    return text;
  }
} // namespace postprocess
