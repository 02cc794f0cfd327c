#include "apps/runs/transmission/model.h"

#include "apps/runs/transmission/methods.h"
#include "apps/specimens/specimen_packing.h"
#include "apps/text/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace apps
{
  std::vector<coupling::WaveMethod> TransmissionModel::chosen() const
  {
    std::vector<coupling::WaveMethod> found;
    for (const std::string &name : methods)
      {
        const auto &all = wave_methods();
        const auto  one =
          std::find_if(all.begin(), all.end(), [&](const coupling::WaveMethod &m) { return m.name == name; });
        if (one == all.end())
          return {};
        found.push_back(*one);
        found.back().proportions = proportions;
      }
    return found;
  }

  coupling::WaveCase TransmissionModel::wave(const coupling::WaveMethod &method, const double length) const
  {
    coupling::WaveCase one = common;
    one.compact            = compact_with_progress;
    one.method             = method;
    one.angle              = degrees * M_PI / 180;
    one.wavelength         = length;
    return one;
  }

  void TransmissionModel::check(const base::EntryPath &root) const
  {
    const base::EntryPath s        = root.at("Waves");
    const double          shortest = 4 * common.medium.spacing, longest = 1e4 * common.medium.spacing;
    if (wavelengths.empty() || std::any_of(wavelengths.begin(), wavelengths.end(), [&](const double length) {
          return !(length >= shortest && length < longest);
        }))
      s.refuse("Wavelengths", fmt::format("expected numbers from {} to {} m, 4 to 10000 spacings, separated by commas.",
                                          shortest, longest));
    if (chosen().empty())
      s.refuse("Methods", "expected names among " + wave_method_names() + ", separated by commas.");
    const bool one_way = common.medium.lattice == coupling::WaveMedium::Lattice::chain ||
                         common.medium.lattice == coupling::WaveMedium::Lattice::bar;
    if (common.shear && one_way)
      s.refuse("Shear", "particles in a row or bar move along it. Take Medium = strip.");
    if (common.medium.scatter > 0 && common.medium.lattice == coupling::WaveMedium::Lattice::bar)
      s.refuse("Scatter", "spheres in a bar have no order as it is. Take Medium = chain, strip or plane.");
  }
} // namespace apps
