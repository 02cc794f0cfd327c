#include "coupling/promotion/carried_motion.h"

#include "dem/observation/path_output.h"

#include <algorithm>
#include <map>
#include <utility>

namespace coupling
{
  using Eigen::Index;
  using Eigen::Vector3d;

  namespace
  {
    /** The part of a motion that a carrier can do itself. */
    base::Vector6 free_part(base::Vector6 motion, const dem::HeldMotions held)
    {
      for (int c = 0; c < dem::motions; ++c)
        if ((held & dem::HeldMotions(1u << c)) != 0)
          motion[c] = 0;
      return motion;
    }
  } // namespace

  dem::LoadedMotion motion_of_all(const dem::LoadedNetwork &whole,
                                  const AwakeParticles     &awake,
                                  const dem::LoadedMotion  &of_awake,
                                  const PlaceMotions       &in_solid)
  {
    dem::LoadedMotion motion(whole.held.size());
    for (std::size_t i = 0; i < in_solid.size(); ++i)
      if (in_solid[i])
        motion.particles.col(static_cast<Index>(i)) = in_solid[i]->motion();
    const std::vector<Vector3d> displacement = dem::displacements_of(awake.network, of_awake);
    for (std::size_t k = 0; k < awake.numbers.size(); ++k)
      {
        auto column = motion.particles.col(static_cast<Index>(awake.numbers[k]));
        column << displacement[k], of_awake.particles.col(static_cast<Index>(k)).tail<3>();
      }
    return motion;
  }

  dem::LoadedMotion
  start_from(const CarriedMotion &known, const AwakeParticles &now, const PlaceMotions &still_in_solid)
  {
    dem::LoadedMotion start(now.network.held.size());
    start.loads                            = known.of_before.loads;
    const std::vector<std::size_t> &before = known.before.numbers;
    for (std::size_t k = 0; k < now.numbers.size(); ++k)
      {
        const std::size_t i         = now.numbers[k];
        const auto        was       = std::lower_bound(before.begin(), before.end(), i);
        const bool        was_awake = was != before.end() && *was == i;
        start.particles.col(static_cast<Index>(k)) =
          still_in_solid[i] ? free_part(known.in_solid[i]->motion(), now.network.held[k]) :
          was_awake         ? base::Vector6(known.of_before.particles.col(was - before.begin())) :
                              free_part(known.of_all.particles.col(static_cast<Index>(i)), now.network.held[k]);
      }
    for (std::size_t j = 0; j < known.joints.size(); ++j)
      {
        const std::size_t carrier = now.numbers.size() + j;
        base::Vector6     moved   = known.joints[j]->motion();
        moved.tail<3>().setZero();
        start.particles.col(static_cast<Index>(carrier)) = free_part(moved, now.network.held[carrier]);
      }
    return start;
  }

  std::vector<std::optional<std::size_t>> links_before(const AwakeParticles &before, const AwakeParticles &now)
  {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> number;
    const auto key = [](const dem::ElasticLink &link, const std::vector<std::size_t> &of_packing) {
      return std::pair{of_packing[static_cast<std::size_t>(link.first)],
                       of_packing[static_cast<std::size_t>(link.second)]};
    };
    const std::vector<dem::ElasticLink> &old = before.network.network.links;
    for (std::size_t l = 0; l < old.size(); ++l)
      number.emplace(key(old[l], before.numbers), l);
    std::vector<std::optional<std::size_t>> found;
    for (const dem::ElasticLink &link : now.network.network.links)
      {
        const auto at = number.find(key(link, now.numbers));
        found.push_back(at == number.end() ? std::nullopt : std::optional(at->second));
      }
    return found;
  }
} // namespace coupling
