#include "apps/runs/particles/particle_numbers.h"

#include "apps/text/value_text.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace apps
{
  std::vector<std::size_t> read_particle_numbers(const std::string &file, const std::size_t particles)
  {
    std::ifstream in(file);
    if (!in)
      throw base::InputError(file + ": cannot be read.");
    std::map<std::size_t, int> first_line; // by number, from 0
    int                        number_of_line = 0;
    for (std::string line; std::getline(in, line);)
      {
        ++number_of_line;
        line.erase(std::min(line.find('#'), line.size()));
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream words(line);
        for (std::string word; words >> word;)
          {
            const auto number = integer_in(word);
            const auto refuse = [&](const std::string &why) {
              throw base::InputError(fmt::format("{}:{}: \"{}\" {}", file, number_of_line, word, why));
            };
            if (!number)
              refuse("is not a whole number.");
            if (*number < 1 || static_cast<std::size_t>(*number) > particles)
              refuse(fmt::format("is none of the particles, which are numbered from 1 to {}.", particles));
            const auto [at, fresh] = first_line.emplace(static_cast<std::size_t>(*number - 1), number_of_line);
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
