#include "dem/network/mechanisms.h"

#include "dem/core/uniform_random.h"
#include "dem/network/particle_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dem
{
  namespace
  {
    /** Of the start's amplitude; converged probes are below by orders where links resist, and of order one where none does. */
    constexpr double participates = 1e-4;

    double &value(Fields &x, const std::size_t i, const int motion, const int lane)
    {
      return x[(motions * i + motion) * load_lanes + lane];
    }

    /** The translation that most particles share, component by component, is that of the network: take it out. */
    void remove_common_translation(const StiffnessOperator &stiffness, Fields &x)
    {
      const std::size_t   n = stiffness.particles();
      std::vector<double> column(n);
      for (int lane = first_probe; lane < load_lanes; ++lane)
        for (int c = 0; c < 3; ++c)
          {
            for (std::size_t i = 0; i < n; ++i)
              column[i] = value(x, i, c, lane);
            std::nth_element(column.begin(), column.begin() + n / 2, column.end());
            for (std::size_t i = 0; i < n; ++i)
              if (!stiffness.is_held(i, c))
                value(x, i, c, lane) -= column[n / 2];
          }
    }

    /** Twice the energy of the probes: work of a particle's forces, and what it would cost to move it alone, averaged over directions. */
    struct Energies
    {
      std::vector<double> spent, own;
    };

    Energies energies(const StiffnessOperator &stiffness, const Fields &x)
    {
      Fields force(x.size());
      stiffness.apply(x, force);
      const std::vector<Block> diagonal = stiffness.diagonal_blocks();
      Energies                 e{std::vector<double>(diagonal.size(), 0.0), std::vector<double>(diagonal.size(), 0.0)};
      for (std::size_t i = 0; i < diagonal.size(); ++i)
        for (int lane = first_probe; lane < load_lanes; ++lane)
          {
            Eigen::Matrix<double, motions, 1> u, f;
            for (int c = 0; c < motions; ++c)
              {
                u[c] = x[(motions * i + c) * load_lanes + lane];
                f[c] = force[(motions * i + c) * load_lanes + lane];
              }
            e.spent[i] += u.dot(f);
            // Not the block itself: a particle's own mechanism costs nothing there either.
            e.own[i] += diagonal[i].trace() * u.squaredNorm();
          }
      return e;
    }
  } // namespace

  void fill_probes(const StiffnessOperator &stiffness, Fields &x)
  {
    UniformRandom random(20250101);
    for (std::size_t i = 0; i < stiffness.particles(); ++i)
      for (int c = 0; c < motions; ++c)
        for (int lane = first_probe; lane < load_lanes; ++lane)
          {
            const double amplitude = random() - 0.5;
            value(x, i, c, lane)   = stiffness.is_held(i, c) ? 0.0 : amplitude * stiffness.length_scale();
          }
  }

  std::vector<Mechanism> find_mechanisms(const StiffnessOperator &stiffness, Fields x, const bool translates)
  {
    const std::size_t n = stiffness.particles();
    if (translates)
      remove_common_translation(stiffness, x);

    std::vector<char> takes_part(n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (int c = 0; c < motions; ++c)
        for (int lane = first_probe; lane < load_lanes; ++lane)
          takes_part[i] |= std::fabs(value(x, i, c, lane)) > participates * stiffness.length_scale();

    ParticleGroups                                     groups(n);
    std::vector<std::pair<std::int32_t, std::int32_t>> outward;
    for (std::size_t l = 0; l < stiffness.links(); ++l)
      {
        const auto [J, K] = stiffness.ends(l);
        if (takes_part[J] && takes_part[K])
          groups.join(J, K);
        else if (takes_part[J] || takes_part[K])
          outward.emplace_back(J, K);
      }

    const Energies                    energy = energies(stiffness, x);
    std::map<std::int32_t, Mechanism> found;
    std::map<std::int32_t, double>    spent, own;
    for (std::size_t i = 0; i < n; ++i)
      if (takes_part[i])
        {
          const std::int32_t root = groups.group_of(static_cast<std::int32_t>(i));
          found[root].particles.push_back(stiffness.order()[i]);
          spent[root] += energy.spent[i];
          own[root] += energy.own[i];
        }
    for (const auto &[J, K] : outward)
      ++found[groups.group_of(takes_part[J] ? J : K)].links;

    std::vector<Mechanism> mechanisms;
    for (auto &[root, mechanism] : found)
      {
        mechanism.relative_stiffness = own[root] > 0 ? std::fabs(spent[root]) / own[root] : 0.0;
        if (mechanism.relative_stiffness >= negligible_stiffness)
          continue; // soft, but links do resist
        std::sort(mechanism.particles.begin(), mechanism.particles.end());
        mechanisms.push_back(std::move(mechanism));
      }
    std::sort(mechanisms.begin(), mechanisms.end(),
              [](const Mechanism &a, const Mechanism &b) { return a.particles.front() < b.particles.front(); });
    return mechanisms;
  }

  std::vector<std::int32_t> floaters(const std::vector<Mechanism> &mechanisms)
  {
    std::vector<std::int32_t> all;
    for (const Mechanism &m : mechanisms)
      all.insert(all.end(), m.particles.begin(), m.particles.end());
    std::sort(all.begin(), all.end());
    return all;
  }

  std::string describe(const std::vector<Mechanism> &mechanisms, const std::size_t named)
  {
    if (mechanisms.empty())
      return "";
    const std::vector<std::int32_t> all = floaters(mechanisms);
    std::string text = std::to_string(all.size()) + (all.size() == 1 ? " particle moves" : " particles move") +
                       " without resistance of any link, in " + std::to_string(mechanisms.size()) +
                       (mechanisms.size() == 1 ? " mechanism: " : " mechanisms: ");
    for (std::size_t k = 0; k < mechanisms.size() && k < named; ++k)
      {
        const Mechanism &m = mechanisms[k];
        text += (k ? ", " : "") + std::string(m.particles.size() == 1 ? "particle " : "a group from particle ") +
                std::to_string(m.particles.front() + 1) + " (" +
                (m.particles.size() == 1 ? "" : std::to_string(m.particles.size()) + " particles, ") +
                std::to_string(m.links) + (m.links == 1 ? " link)" : " links)");
      }
    return text + (mechanisms.size() > named ? ", ..." : "") + ".";
  }
} // namespace dem
