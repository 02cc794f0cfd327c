#include "fem/mesh/sides.h"

namespace fem
{
  void name_by_axis(std::map<std::string, dealii::types::boundary_id> &boundaries)
  {
    const std::map<std::string, dealii::types::boundary_id> by_word = boundaries;
    for (const auto &[name, id] : by_word)
      {
        const std::size_t blank = name.rfind(' ');
        const std::size_t word  = blank == std::string::npos ? 0 : blank + 1;
        for (const SideName &side : side_names)
          if (name.compare(word, std::string::npos, side.word) == 0)
            boundaries.emplace(name.substr(0, word) + side.by_axis, id);
      }
  }
}
