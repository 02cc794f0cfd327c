#include "postprocess/files/page_contents.h"

#include "base/errors.h"
#include "postprocess/files/digest.h"

#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace postprocess
{
  namespace
  {
    std::string unescaped(std::string_view text)
    {
      constexpr std::array<std::pair<std::string_view, char>, 4> marks = {
        {{"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&amp;", '&'}}};
      std::string plain;
      while (!text.empty())
        {
          std::size_t taken = 1;
          char        next  = text.front();
          for (const auto &[mark, letter] : marks)
            if (text.substr(0, mark.size()) == mark)
              {
                taken = mark.size();
                next  = letter;
              }
          plain += next;
          text.remove_prefix(taken);
        }
      return plain;
    }

    /** What stands between two marks from a place on, which moves behind the second; nothing where there is none. */
    std::optional<std::string_view>
    between(const std::string &page, std::size_t &from, const std::string &opening, const std::string &closing)
    {
      const std::size_t begin = page.find(opening, from);
      const std::size_t end   = begin == std::string::npos ? begin : page.find(closing, begin + opening.size());
      if (end == std::string::npos)
        return std::nullopt;
      from = end + closing.size();
      return std::string_view(page).substr(begin + opening.size(), end - begin - opening.size());
    }

    AttachedFile attached(const std::string &text, const std::string &origin)
    {
      std::size_t from   = 0;
      const auto  refuse = [&](const std::string &entry) {
        throw base::InputError(origin + ": the file of " + entry + " in this page is damaged.");
      };
      const std::size_t entry_end = text.find('"');
      AttachedFile      file{unescaped(std::string_view(text).substr(0, entry_end)), "", 0, std::nullopt};
      const auto        named  = between(text, from, "data-named=\"", "\"");
      const auto        digest = between(text, from, "data-digest=\"", "\">");
      if (!named || !digest ||
          std::from_chars(digest->data(), digest->data() + digest->size(), file.digest, 16).ec != std::errc())
        refuse(file.entry);
      file.named = unescaped(*named);
      if (from == text.size())
        return file;
      file.content = bytes_of_base64(text.substr(from));
      if (!file.content || Digest().add(*file.content).value() != file.digest)
        refuse(file.entry);
      return file;
    }
  } // namespace

  bool is_page_text(const std::string &content) { return content.rfind(page_opening, 0) == 0; }

  PageContents read_page_contents(const std::string &page, const std::string &origin)
  {
    PageContents found;
    std::size_t  from  = 0;
    const auto   scene = between(page, from, scene_opening, scene_closing);
    if (!scene)
      throw base::InputError(
        origin + ": there is no scene in this page; pages of runs, studies and calibrations have one (report.html).");
    found.scene = unescaped(*scene);
    from        = 0;
    while (const auto file = between(page, from, attachment_opening, attachment_closing))
      found.files.push_back(attached(std::string(*file), origin));
    return found;
  }

  std::optional<std::string> bytes_of_base64(const std::string &text)
  {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<int, 256>       value;
    value.fill(-1);
    for (std::size_t k = 0; k < letters.size(); ++k)
      value[static_cast<unsigned char>(letters[k])] = static_cast<int>(k);
    if (text.size() % 4 != 0)
      return std::nullopt;
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (std::size_t at = 0; at < text.size(); at += 4)
      {
        const std::size_t given = at + 4 < text.size() || text[at + 3] != '=' ?
                                    4 :
                                    (text[at + 2] != '=' ? 3 : 2); // the last ones may be padding
        std::uint32_t     bits  = 0;
        for (std::size_t k = 0; k < 4; ++k)
          {
            const int letter = k < given ? value[static_cast<unsigned char>(text[at + k])] : 0;
            if (letter < 0)
              return std::nullopt;
            bits = bits << 6 | static_cast<std::uint32_t>(letter);
          }
        for (std::size_t k = 0; k + 1 < given; ++k)
          bytes += static_cast<char>(bits >> (16 - 8 * k) & 255);
      }
    return bytes;
  }
} // namespace postprocess
