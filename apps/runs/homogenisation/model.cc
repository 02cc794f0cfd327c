#include "apps/runs/homogenisation/model.h"

#include "apps/specimens/specimen_packing.h"
#include "postprocess/packings/packing_io.h"

#include <algorithm>

namespace apps
{
  namespace
  {
    bool are_within(const std::vector<double> &numbers, const double least, const double most)
    {
      return !numbers.empty() && std::all_of(numbers.begin(), numbers.end(),
                                             [&](const double number) { return number >= least && number <= most; });
    }
  } // namespace

  void HomogenisationModel::check(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Homogenisation");
    if (!are_within(interaction_ratios, 1, 10))
      s.refuse("Interaction ratios", "expected numbers from 1 to 10, separated by commas, e.g. 1.05, 1.25, 1.5.");
    if (!are_within(shear_ratios, 1e-12, 1e12))
      s.refuse("Shear ratios", "expected numbers above 0, from 1e-12 to 1e12, separated by commas, e.g. 0.1, 0.2, 1.");
    if (thickness > 0 && source == SpecimenSection::Source::generator)
      s.refuse("Thickness", "packings of discs are not made here. Take one from a file.");
  }

  std::vector<dem::Packing> HomogenisationModel::packings() const
  {
    if (source == SpecimenSection::Source::file)
      return {postprocess::read_packing(file, length_unit)};
    std::vector<dem::Packing> made;
    for (std::int64_t seed = 1; seed <= seeds; ++seed)
      made.push_back(made_packing(seed));
    return made;
  }

  dem::Packing HomogenisationModel::made_packing(const std::int64_t seed) const
  {
    dem::CompactionParameters parameters;
    parameters.radius   = radius;
    parameters.count    = static_cast<std::size_t>(particles);
    parameters.friction = friction;
    parameters.seed     = static_cast<std::uint64_t>(seed);
    return compact_with_progress(parameters).packing;
  }

  HomogenisationQuestion HomogenisationModel::question(const double interaction_ratio, const double shear_ratio) const
  {
    HomogenisationQuestion requested;
    requested.links.dimension         = thickness > 0 ? 2 : 3;
    requested.links.thickness         = thickness;
    requested.links.interaction_ratio = interaction_ratio;
    requested.links.shear_ratio       = shear_ratio;
    requested.links.normal_modulus    = normal_modulus;
    requested.solver.tolerance        = tolerance;
    return requested;
  }
} // namespace apps
