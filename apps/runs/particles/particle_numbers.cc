#include "apps/runs/particles/particle_numbers.h"

#include "apps/text/value_text.h"
#include "base/errors.h"
#include "postprocess/files/numeric_text.h"

#include <fmt/format.h>

#include <map>
#include <string_view>

namespace apps
{
  std::vector<std::size_t> read_particle_numbers(const std::string &file, const std::size_t particles)
  {
    const std::string                  text = postprocess::numeric_text::read_text(file);
    std::map<std::size_t, std::size_t> first_line; // by number, from 0
    std::vector<std::string_view>      words;
    for (postprocess::numeric_text::Lines lines(text); lines.next();)
      {
        postprocess::numeric_text::split(lines.text().substr(0, lines.text().find('#')), words);
        for (const std::string_view word : words)
          {
            const auto number = integer_in(std::string(word));
            const auto refuse = [&](const std::string &why) {
              throw base::InputError(fmt::format("{}:{}: \"{}\" {}", file, lines.number(), word, why));
            };
            if (!number)
              refuse("is not a whole number.");
            if (*number < 1 || static_cast<std::size_t>(*number) > particles)
              refuse(fmt::format("is none of the particles, which are numbered from 1 to {}.", particles));
            const auto [at, fresh] = first_line.emplace(static_cast<std::size_t>(*number - 1), lines.number());
            if (!fresh)
              refuse(fmt::format("is there a second time; first in line {}.", at->second));
          }
      }
    if (first_line.empty())
      throw base::InputError(file + ": there is no particle number in it.");
    std::vector<std::size_t> numbers;
    for (const auto &[number, line] : first_line)
      numbers.push_back(number);
    return numbers;
  }
} // namespace apps
