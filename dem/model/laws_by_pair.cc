#include "dem/model/laws_by_pair.h"

#include "dem/model/links.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_set>
#include <utility>

namespace dem
{
  namespace
  {
    using Laws = std::vector<std::shared_ptr<const LinkLaw>>;

    std::string names_of(const Laws &laws)
    {
      std::string names;
      for (const auto &law : laws)
        if (("," + names + ",").find("," + std::string(law->name()) + ",") == std::string::npos)
          names += (names.empty() ? "" : ",") + std::string(law->name());
      return names;
    }

    LinkLawTraits traits_of(const Laws &laws, const std::vector<std::int32_t> &kinds)
    {
      const auto any = [&](bool (LinkLaw::*has)() const) {
        return std::any_of(laws.begin(), laws.end(), [&](const auto &law) { return (*law.*has)(); });
      };
      LinkLawTraits traits;
      traits.name            = names_of(laws);
      traits.pairs           = kinds.size();
      traits.planar          = laws.front()->planar();
      traits.has_moment      = any(&LinkLaw::has_moment);
      traits.breaks_in_place = any(&LinkLaw::breaks_in_place);
      traits.bonds           = any(&LinkLaw::bonds);
      traits.waits           = std::all_of(laws.begin(), laws.end(), [](const auto &law) { return law->waits(); });
      traits.stiffens        = any(&LinkLaw::stiffens);
      traits.rate_dependent  = any(&LinkLaw::rate_dependent);
      traits.kinds           = kinds;
      for (std::size_t pair = 0; pair < kinds.size(); ++pair)
        traits.damping_ratio.push_back(laws[static_cast<std::size_t>(kinds[pair])]->damping_ratio(pair));
      return traits;
    }
  } // namespace

  LawsByPair::LawsByPair(std::vector<std::shared_ptr<const LinkLaw>> laws, std::vector<std::int32_t> kinds)
    : LinkLaw(traits_of(laws, kinds))
    , law(std::move(laws))
    , kind(std::move(kinds))
  {
    std::size_t columns = 0;
    for (std::size_t pair = 0; pair < kind.size(); ++pair)
      if (pair >= law_of(pair).pairs())
        throw std::logic_error("a law among several lacks constants of a pair");
    for (const auto &each : law)
      {
        first_column.push_back(columns);
        columns += each->columns().size();
      }
  }

  void LawsByPair::run_all(LinkSet &links, const Particles &particles, const LinkLaw &all, const LinkLines &)
  {
    const auto &of = static_cast<const LawsByPair &>(all);
    if (links.first_block.empty())
      return; // it has had no link yet
    for (std::size_t k = 0; k < of.law.size(); ++k)
      if (const LinkLines lines = {static_cast<std::size_t>(links.first_block[k]),
                                   static_cast<std::size_t>(links.first_block[k + 1]), of.first_column[k]};
          lines.first_block < lines.end_block)
        of.law[k]->pass(Mixture::materials)(links, particles, *of.law[k], lines);
  }

  LinkPass LawsByPair::pass(Mixture) const { return run_all; }

  std::vector<LinkQuantity> LawsByPair::columns() const
  {
    std::vector<LinkQuantity>       all;
    std::unordered_set<std::string> taken;
    for (const auto &each : law)
      for (LinkQuantity quantity : each->columns())
        {
          std::string of_law = each->name();
          std::replace(of_law.begin(), of_law.end(), '-', '_');
          std::string name = quantity.name;
          for (int n = 1; !taken.insert(name).second; ++n) // contacts of several bonds may obey the same law
            name = of_law + (n == 1 ? "_" : "_" + std::to_string(n) + "_") + quantity.name;
          quantity.name = name;
          quantity.meaning += std::string(" (") + each->name() + ")";
          all.push_back(std::move(quantity));
        }
    return all;
  }

  double LawsByPair::reference_length(const std::size_t pair, const NewLink &link) const
  {
    return law_of(pair).reference_length(pair, link);
  }

  void LawsByPair::begin(const std::size_t pair, const NewLink &link, double *history) const
  {
    law_of(pair).begin(pair, link, own(pair, history));
  }

  LinkStiffnesses LawsByPair::stiffness(const std::size_t pair, const LinkGeometry &link, const double *history) const
  {
    return law_of(pair).stiffness(pair, link, own(pair, history));
  }

  LinkStiffnesses
  LawsByPair::damaged_stiffness(const std::size_t pair, const LinkGeometry &link, const double *history) const
  {
    return law_of(pair).damaged_stiffness(pair, link, own(pair, history));
  }

  LinkPhase LawsByPair::phase(const std::size_t pair, const LinkGeometry &link, const double *history) const
  {
    return law_of(pair).phase(pair, link, own(pair, history));
  }

  std::vector<BrokenElement> LawsByPair::broken_elements(const std::size_t      pair,
                                                         const LinkGeometry    &link,
                                                         const Eigen::Vector3d &direction,
                                                         const double          *history) const
  {
    return law_of(pair).broken_elements(pair, link, direction, own(pair, history));
  }

  double LawsByPair::stored(const std::size_t pair, const LinkGeometry &link, const double *history) const
  {
    return law_of(pair).stored(pair, link, own(pair, history));
  }

  double LawsByPair::damage_dissipation(const std::size_t pair, const LinkGeometry &link, const double *history) const
  {
    return law_of(pair).damage_dissipation(pair, link, own(pair, history));
  }

  LinkLoss LawsByPair::damage(const std::size_t pair, const LinkGeometry &link, const double *history) const
  {
    return law_of(pair).damage(pair, link, own(pair, history));
  }

  double LawsByPair::damaging_strain(const std::size_t pair, const double *history) const
  {
    return law_of(pair).damaging_strain(pair, own(pair, history));
  }

  LinkExertion LawsByPair::exertion(const std::size_t      pair,
                                    const LinkGeometry    &link,
                                    const Eigen::Vector3d &direction,
                                    const Eigen::Vector3d &force,
                                    const double          *history) const
  {
    return law_of(pair).exertion(pair, link, direction, force, own(pair, history));
  }

  LinkAnswer
  LawsByPair::update(const std::size_t pair, const LinkStep &step, const double *before, double *history) const
  {
    return law_of(pair).update(pair, step, own(pair, before), own(pair, history));
  }

  base::Matrix6 LawsByPair::tangent(const std::size_t pair,
                                    const LinkStep   &step,
                                    const double     *before,
                                    const double     *history,
                                    const LinkTangent which) const
  {
    return law_of(pair).tangent(pair, step, own(pair, before), own(pair, history), which);
  }
} // namespace dem
