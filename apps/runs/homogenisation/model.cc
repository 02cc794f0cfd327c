#include "apps/runs/homogenisation/model.h"

#include "apps/specimens/specimen_packing.h"
#include "apps/text/value_text.h"
#include "postprocess/packings/packing_io.h"

namespace apps
{
  namespace
  {
    /** Numbers between commas; empty if a part is none, or not from least to most. */
    std::vector<double> numbers_in(const std::string &text, const double least, const double most)
    {
      std::vector<double> numbers;
      for (const std::string &part : comma_separated(text))
        {
          const auto number = number_in(part);
          if (!number || !(*number >= least && *number <= most))
            return {};
          numbers.push_back(*number);
        }
      return numbers;
    }
  } // namespace

  void HomogenisationModel::check(const base::EntryPath &root) const
  {
    const base::EntryPath s = root.at("Homogenisation");
    if (interactions().empty())
      s.refuse("Interaction ratios", "expected numbers from 1 to 10, separated by commas, e.g. 1.05, 1.25, 1.5.");
    if (shears().empty())
      s.refuse("Shear ratios", "expected numbers above 0, from 1e-12 to 1e12, separated by commas, e.g. 0.1, 0.2, 1.");
    if (thickness > 0 && source == SpecimenSection::Source::generator)
      s.refuse("Thickness", "packings of discs are not made here. Take one from a file.");
  }

  std::vector<double> HomogenisationModel::interactions() const { return numbers_in(interaction_ratios, 1, 10); }

  std::vector<double> HomogenisationModel::shears() const { return numbers_in(shear_ratios, 1e-12, 1e12); }

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
    HomogenisationQuestion asked;
    asked.links.dimension         = thickness > 0 ? 2 : 3;
    asked.links.thickness         = thickness;
    asked.links.interaction_ratio = interaction_ratio;
    asked.links.shear_ratio       = shear_ratio;
    asked.links.normal_modulus    = normal_modulus;
    asked.solver.tolerance        = tolerance;
    return asked;
  }
} // namespace apps
