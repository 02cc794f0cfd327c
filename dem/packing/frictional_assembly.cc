#include "dem/packing/frictional_assembly.h"

#include "dem/core/records.h"
#include "dem/core/simd.h"
#include "dem/core/vector.h"
#include "dem/kernels/kinematics.h"
#include "dem/neighbours/cell_list.h"
#include "dem/neighbours/tie.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    constexpr double diameter = 2.0;
    constexpr double inertia  = 0.4; // of a sphere, in mass radius^2
    /// Room between spheres that are taken as candidates: wide enough for few searches, narrow enough for few candidates.
    constexpr double skin     = 0.18;
    constexpr double far_away = 1000; // cells

    double sum(const Pack &values)
    {
      double total = 0;
      for (int lane = 0; lane < pack_size; ++lane)
        total += values[lane];
      return total;
    }

    /** Row `i` of each of eight records of the given particles, as packs. */
    struct Gathered
    {
      Pack quantity[record_size];

      Gathered(const Column &records, const std::int32_t *particle)
      {
        for (int lane = 0; lane < pack_size; ++lane)
          quantity[lane] = load(&records[record_size * particle[lane]]);
        transpose(quantity);
      }
      Vec<Pack, 3> vector(const int from) const { return {{quantity[from], quantity[from + 1], quantity[from + 2]}}; }
    };

    Vec<Pack, 3> load3(const Column (&columns)[3], const std::size_t at)
    {
      return {{load(&columns[0][at]), load(&columns[1][at]), load(&columns[2][at])}};
    }

    void store3(const Vec<Pack, 3> &values, Column (&columns)[3], const std::size_t at)
    {
      for (int d = 0; d < 3; ++d)
        store(values[d], &columns[d][at]);
    }
  } // namespace

  FrictionalAssembly::FrictionalAssembly(const Packing &start, const FrictionalAssemblyParameters &p)
    : parameters(p)
    , particles(start.size())
    , cell_edges(*start.periodic_cell)
    , place(record_size * particles, 0.0)
    , motion(record_size * particles, 0.0)
    , force(record_size * particles, 0.0)
  {
    for (std::size_t i = 0; i < particles; ++i)
      {
        for (int d = 0; d < 3; ++d)
          place[record_size * i + d] = start.centre[i][d];
        place[record_size * i + 6] = 1.0;
      }
    find_candidates();
    update_forces();
  }

  void
  FrictionalAssembly::set_motion(const std::size_t sphere, const Eigen::Vector3d &velocity, const Eigen::Vector3d &spin)
  {
    for (int d = 0; d < 3; ++d)
      {
        motion[record_size * sphere + d]     = parameters.time_step * velocity[d];
        motion[record_size * sphere + 3 + d] = parameters.time_step * spin[d];
      }
  }

  Eigen::Vector3d FrictionalAssembly::spin(const std::size_t sphere) const
  {
    const double *m = &motion[record_size * sphere + 3];
    return Eigen::Vector3d(m[0], m[1], m[2]) / parameters.time_step;
  }

  void FrictionalAssembly::step(const double strain)
  {
    move(strain);
    if (!candidates_are_complete())
      find_candidates();
    update_forces();
  }

  void FrictionalAssembly::move(const double strain)
  {
    alignas(64) double scale_of[record_size] = {1, 1, 1, 1 / inertia, 1 / inertia, 1 / inertia, 0, 0};
    for (double &s : scale_of)
      s *= parameters.time_step * parameters.time_step;
    const Pack scale = load(scale_of), damping(parameters.damping);

    cell_edges *= 1 + strain;
    const double back = searched_edge / cell_edges.x();
    largest_drift_2   = 0;
    for (std::size_t i = 0; i < particles; ++i)
      {
        double *x = &place[record_size * i], *m = &motion[record_size * i];

        const Pack old      = load(m);
        const Pack wanted   = scale * load(&force[record_size * i]);
        const Pack along    = wanted * (old + 0.5 * wanted); // > 0: the particle speeds up
        Pack       allowed  = select(along > 0.0, Pack(1.0 - damping), Pack(1.0 + damping));
        allowed             = select(along == 0.0, Pack(1.0), allowed);
        const Pack velocity = old + allowed * wanted;
        store(velocity, m);

        double drift_2 = 0, angle_2 = 0;
        for (int d = 0; d < 3; ++d)
          {
            x[d]               = (1 + strain) * x[d] + m[d];
            x[3 + d]           = m[3 + d];
            const double drift = back * x[d] - searched_at[3 * i + d];
            drift_2 += drift * drift;
            angle_2 += m[3 + d] * m[3 + d];
          }
        x[6]            = half_tangent_factor(rotation_coefficients(angle_2), angle_2);
        largest_drift_2 = maximum(largest_drift_2, drift_2);
      }
  }

  /** Two spheres left out were at least diameter + skin apart; since then both may have drifted towards each other. */
  bool FrictionalAssembly::candidates_are_complete() const
  {
    const double scale = cell_edges.x() / searched_edge;
    return scale * ((1 - tie) * (diameter + skin) - 2 * std::sqrt(largest_drift_2)) > diameter;
  }

  void FrictionalAssembly::find_candidates()
  {
    std::vector<Eigen::Vector3d> centre(particles);
    searched_at.resize(3 * particles);
    for (std::size_t i = 0; i < particles; ++i)
      for (int d = 0; d < 3; ++d)
        searched_at[3 * i + d] = centre[i][d] = place[record_size * i + d];
    searched_edge     = cell_edges.x();
    const auto found  = find_pairs(centre, std::vector<double>(particles, 1.0), 1.0, skin, cell_edges);
    const auto filled = (found.size() + pack_size - 1) / pack_size * pack_size;

    const auto        old_first = std::move(first), old_second = std::move(second);
    Column            old_shift[3], old_branch[3], old_slip[3];
    const std::size_t old_candidates = candidates;
    for (int d = 0; d < 3; ++d)
      {
        old_shift[d]  = std::move(shift[d]);
        old_branch[d] = std::move(branch[d]);
        old_slip[d]   = std::move(slip[d]);
      }
    const auto old_pair = [&](const std::size_t c) {
      return NeighbourPair{old_first[c],
                           old_second[c],
                           {{static_cast<std::int8_t>(old_shift[0][c]), static_cast<std::int8_t>(old_shift[1][c]),
                             static_cast<std::int8_t>(old_shift[2][c])}}};
    };

    // The filling joins the first particle with an image of its own too far away ever to touch.
    candidates = found.size();
    first.assign(filled, 0);
    second.assign(filled, 0);
    for (int d = 0; d < 3; ++d)
      {
        shift[d].assign(filled, d == 0 ? far_away : 0.0);
        branch[d].assign(filled, d == 0 ? far_away * cell_edges.x() : 0.0);
        slip[d].assign(filled, 0.0);
      }
    std::size_t old = 0;
    for (std::size_t c = 0; c < candidates; ++c)
      {
        const NeighbourPair &pair = found[c];
        first[c]                  = pair.first;
        second[c]                 = pair.second;
        while (old < old_candidates && old_pair(old) < pair)
          ++old;
        const bool known = old < old_candidates && old_pair(old) == pair;
        for (int d = 0; d < 3; ++d)
          {
            shift[d][c]  = pair.shift[d];
            branch[d][c] = known ? old_branch[d][old] :
                                   centre[pair.second][d] + cell_edges[d] * pair.shift[d] - centre[pair.first][d];
            slip[d][c]   = known ? old_slip[d][old] : 0.0;
          }
      }
  }

  void FrictionalAssembly::update_forces()
  {
    std::fill(force.begin(), force.end(), 0.0);
    alignas(64) const double reaction_of[record_size] = {-1, -1, -1, 1, 1, 1, 1, 1};
    const Pack               reaction                 = load(reaction_of);
    const Pack friction(parameters.friction), shear_ratio(parameters.shear_ratio), half(0.5), one(1.0), zero(0.0);
    const Pack edge[3] = {Pack(cell_edges[0]), Pack(cell_edges[1]), Pack(cell_edges[2])};
    Pack       virial(0.0), overlaps(0.0), forces(0.0), touching_count(0.0);

    for (std::size_t at = 0; at < first.size(); at += pack_size)
      {
        const Gathered     j(place, &first[at]), k(place, &second[at]);
        const Vec<Pack, 3> before = load3(branch, at);
        PairMotion<Pack>   m;
        const Vec<Pack, 3> image = load3(shift, at);
        m.branch =
          k.vector(0) - j.vector(0) + Vec<Pack, 3>{{edge[0] * image[0], edge[1] * image[1], edge[2] * image[2]}};
        const Pack distance = dot(m.branch, m.branch);
        const auto touching = distance < Pack(diameter * diameter);
        store3(m.branch, branch, at);
        if (!any(touching))
          {
            store3({{zero, zero, zero}}, slip, at);
            continue;
          }
        m.increment     = m.branch - before;
        m.mean_rotation = half * (j.vector(3) + k.vector(3));
        m.arm_rotation  = (half * j.quantity[6]) * j.vector(3) + (half * k.quantity[6]) * k.vector(3);

        Vec<Pack, 3>          tangential[1] = {load3(slip, at)};
        const LinkFrame<Pack> frame         = advance_shear<true>(m, one, tangential);
        const auto            touched       = dot(before, before) < Pack(diameter * diameter);
        const Pack            overlap       = select(touching, Pack(diameter - frame.length), zero);

        const Pack trial  = shear_ratio * square_root(dot(tangential[0], tangential[0]));
        const Pack limit  = friction * overlap;
        const Pack sticks = select(trial > limit, Pack(limit / maximum(trial, Pack(1e-300))), one);
        const Pack kept   = select(touching && touched, sticks, zero);
        tangential[0]     = select(kept > zero, kept, zero) * tangential[0];
        store3(tangential[0], slip, at);

        const Vec<Pack, 3> f      = shear_ratio * tangential[0] - overlap * frame.direction;
        const Vec<Pack, 3> moment = half * cross(m.branch, f);
        virial                    = virial + overlap * frame.length;
        overlaps                  = overlaps + overlap;
        forces                    = forces + square_root(dot(f, f));
        touching_count            = touching_count + select(touching, one, zero);

        Pack record[record_size] = {f[0], f[1], f[2], moment[0], moment[1], moment[2], zero, zero};
        transpose(record);
        for (int lane = 0; lane < pack_size; ++lane)
          {
            double *on_first  = &force[record_size * first[at + lane]],
                   *on_second = &force[record_size * second[at + lane]];
            store(load(on_first) + record[lane], on_first);
            store(load(on_second) + reaction * record[lane], on_second);
          }
      }
    overlap_times_length = sum(virial);
    overlap_sum          = sum(overlaps);
    force_sum            = sum(forces);
    contact_count        = static_cast<std::int64_t>(sum(touching_count));
  }

  double FrictionalAssembly::pressure() const
  {
    return overlap_times_length / (3 * cell_edges[0] * cell_edges[1] * cell_edges[2]);
  }

  AssemblyMeasures FrictionalAssembly::measures() const
  {
    double unbalanced = 0;
    for (std::size_t i = 0; i < particles; ++i)
      {
        const double *f = &force[record_size * i];
        unbalanced += std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
      }
    const double contacts = static_cast<double>(contact_count);
    const double ratio    = force_sum > 0 ? (unbalanced / static_cast<double>(particles)) / (force_sum / contacts) :
                                            std::numeric_limits<double>::infinity();
    return {pressure(), ratio, contact_count > 0 ? overlap_sum / contacts : 0.0, contact_count};
  }

  std::vector<Eigen::Vector3d> FrictionalAssembly::centres() const
  {
    std::vector<Eigen::Vector3d> result(particles);
    for (std::size_t i = 0; i < particles; ++i)
      for (int d = 0; d < 3; ++d)
        {
          const double x = place[record_size * i + d];
          result[i][d]   = x - cell_edges[d] * std::floor(x / cell_edges[d]);
        }
    return result;
  }
} // namespace dem
