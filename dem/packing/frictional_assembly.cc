#include "dem/packing/frictional_assembly.h"

#include "dem/core/records.h"
#include "dem/kernels/kinematics.h"
#include "dem/laws/linear_contact.h"
#include "dem/model/particles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    constexpr std::size_t spheres_in_block = 256;
    /// Below, threads cost more than they spare.
    constexpr std::size_t worth_threads = 4096;
    constexpr double      inertia       = 2.0 / 5.0;
    /// The law speaks of strains over the reference length 2 (two radii) and of stresses: with an area of 1, k_n = modulus/2.
    constexpr double reference = 2.0, area = 1.0;

    using Record = double[record_size];

    alignas(64) constexpr Record difference_and_sum = {-1, -1, -1, 1, 1, 1, 0, 0};
    alignas(64) constexpr Record inverse_inertias   = {1, 1, 1, 1 / inertia, 1 / inertia, 1 / inertia, 0, 0};
    alignas(64) constexpr Record of_centre          = {1, 1, 1, 0, 0, 0, 0, 0};

    std::size_t blocks_of(const std::size_t count, const std::size_t in_block)
    {
      return (count + in_block - 1) / in_block;
    }

    double largest_of(const Pack &pack)
    {
      alignas(64) Record lanes;
      store(pack, lanes);
      return *std::max_element(lanes, lanes + record_size);
    }

    Eigen::Matrix3d loose_cell(const Packing &start) { return start.periodic_cell->asDiagonal(); }

    std::vector<std::int32_t> inverse(const std::vector<std::int32_t> &order)
    {
      std::vector<std::int32_t> rank(order.size());
      for (std::size_t place = 0; place < order.size(); ++place)
        rank[static_cast<std::size_t>(order[place])] = static_cast<std::int32_t>(place);
      return rank;
    }

    base::Column poses(const Packing &start, const std::vector<std::int32_t> &order, const SphereShare &share)
    {
      base::Column pose(record_size * share.own(), 0.0);
      for (std::size_t i = 0; i < share.own(); ++i)
        std::copy_n(start.centre[static_cast<std::size_t>(order[share.first() + i])].data(), 3, &pose[record_size * i]);
      return pose;
    }

    LinearContactNumbers<double> law_of(const FrictionalAssemblyParameters &p)
    {
      return {reference / area, reference / area * p.shear_ratio, p.friction};
    }

    /** Branch of eight pairs, and the sum of the turns of their ends in the last step. */
    struct Ends
    {
      Vec<Pack, 3> branch, turns;

      BRECCIA_KERNEL Ends(const SpherePairs &pairs, const base::Column &pose, const Cell &cell, const std::size_t line)
      {
        const Pack signs = load(difference_and_sum);
        Pack       ends[8];
        for (int lane = 0; lane < pack_size; ++lane)
          {
            const auto J = record_size * static_cast<std::size_t>(pairs.first[line + lane]),
                       K = record_size * static_cast<std::size_t>(pairs.second[line + lane]),
                       k = record_size * static_cast<std::size_t>(pairs.image[line + lane]);
            ends[lane]   = multiply_add(signs, load(&pose[J]), load(&pose[K])) + load(&cell.offset[k]);
          }
        transpose(ends);
        branch = {{ends[0], ends[1], ends[2]}};
        turns  = {{ends[3], ends[4], ends[5]}};
      }
    };

    /** Read a vector of eight lines from its columns and put another in its place. */
    BRECCIA_KERNEL Vec<Pack, 3> read(const std::array<base::Column, 3> &columns, const std::size_t line)
    {
      return {{load(&columns[0][line]), load(&columns[1][line]), load(&columns[2][line])}};
    }
    BRECCIA_KERNEL void write(std::array<base::Column, 3> &columns, const std::size_t line, const Vec<Pack, 3> &vector)
    {
      for (int d = 0; d < 3; ++d)
        store(vector[d], &columns[d][line]);
    }

    /** Local damping: forces that drive a motion are lessened, those that brake it raised. */
    BRECCIA_KERNEL Pack damped(const Pack &acceleration, const Pack &velocity, const double step, const double damping)
    {
      const Pack ahead = acceleration * multiply_add(Pack(0.5 * step), acceleration, velocity), zero(0.0);
      return acceleration *
             (Pack(1.0) - select(ahead > zero, Pack(damping), select(ahead < zero, Pack(-damping), zero)));
    }
  } // namespace

  /** How deep spheres lie in the plates, along each direction: the force of these on them, as their stiffness is 1. */
  struct FrictionalAssembly::Plates
  {
    alignas(64) Record low, high; ///< where centres are that touch; of what is no place, beyond all bounds

    explicit Plates(const Eigen::Vector3d &edges)
    {
      constexpr double never = std::numeric_limits<double>::max();
      std::fill_n(low, record_size, -never), std::fill_n(high, record_size, never);
      std::fill_n(low, 3, 1.0);
      for (Eigen::Index d = 0; d < 3; ++d)
        high[d] = edges[d] - 1;
    }

    Pack in_low(const double *const pose) const { return maximum(load(low) - load(pose), Pack(0.0)); }
    Pack in_high(const double *const pose) const { return maximum(load(pose) - load(high), Pack(0.0)); }
    Pack push(const double *const pose) const { return in_low(pose) - in_high(pose); }
  };

  FrictionalAssembly::FrictionalAssembly(const Packing                      &start,
                                         const FrictionalAssemblyParameters &parameters,
                                         Ranks *const                        ranks)
    : material(parameters)
    , share(start.size(), ranks)
    , order(hilbert_order(start.centre))
    , rank(inverse(order))
    , cell(loose_cell(start), 3)
    , pose(poses(start, order, share))
    , velocity(record_size * share.own(), 0.0)
    , pairs(share, pose, cell)
  {
    find_forces();
  }

  void
  FrictionalAssembly::set_motion(const std::size_t sphere, const Eigen::Vector3d &moves, const Eigen::Vector3d &spins)
  {
    double *record = &velocity[record_size * static_cast<std::size_t>(rank[sphere])];
    std::copy_n(moves.data(), 3, record);
    std::copy_n(spins.data(), 3, record + 3);
  }

  Eigen::Vector3d FrictionalAssembly::spin(const std::size_t sphere) const
  {
    return Eigen::Vector3d(&velocity[record_size * static_cast<std::size_t>(rank[sphere]) + 3]);
  }

  void FrictionalAssembly::advance(const std::int64_t steps, const std::function<double(double)> &strain)
  {
    for (std::int64_t step = 0; step < steps; ++step)
      {
        move(strain(pressure));
        find_forces();
      }
  }

  void FrictionalAssembly::find_forces() { pressure = (pushed_by_pairs() + pushed_by_plates()) / (3 * volume()); }

  double FrictionalAssembly::pushed_by_pairs()
  {
    force.resize(record_size * pairs.lines());
    const LineBlocks                    &blocks = pairs.blocks();
    const std::vector<LineBlocks::Part> &parts  = blocks.parts();
    std::vector<Pack>                    sums(blocks.blocks());
    LineBlocks::Terms                    head{base::Column(blocks.lines_of_head()), {}};
    head.other        = head.one;
    const auto ignore = [](std::size_t, const Pack &, const Pack &) {};
#pragma omp parallel for schedule(static) if (share.own() > worth_threads)
    for (std::size_t p = 0; p < parts.size(); ++p)
      {
        const auto &[begin, end, kind, number] = parts[p];
        if (kind == LineBlocks::Part::block)
          sums[number] = lines_forces(begin, end, ignore);
        else if (kind == LineBlocks::Part::copy)
          lines_forces(begin, end, ignore);
        else
          lines_forces(begin, end, [&head, from = begin](const std::size_t l, const Pack &normal, const Pack &length) {
            store(normal, &head.one[l - from]);
            store(length, &head.other[l - from]);
          });
      }
    return blocks.total(share, sums, head);
  }

  Eigen::Vector3d FrictionalAssembly::edges() const
  {
    const Eigen::Vector3d of_cell = cell.base().diagonal();
    return material.plates ? of_cell - Eigen::Vector3d::Constant(beyond_plates) : of_cell;
  }

  double FrictionalAssembly::volume() const { return material.plates ? edges().prod() : cell.volume(); }

  double FrictionalAssembly::pushed_by_plates() const
  {
    if (!material.plates)
      return 0;
    const Plates       plates(edges());
    alignas(64) Record lanes = {};
    share.in_turn(lanes, record_size, [&] {
      Pack sum = load(lanes);
      for (std::size_t i = 0; i < share.own(); ++i)
        {
          const double *const at  = &pose[record_size * i];
          const Pack          low = plates.in_low(at), high = plates.in_high(at);
          sum = sum + (low * (Pack(1.0) - low) + high * (Pack(1.0) - high));
        }
      store(sum, lanes);
    });
    return sum_of(load(lanes));
  }

  template <typename Note>
  Pack FrictionalAssembly::lines_forces(const std::size_t begin, const std::size_t end, const Note &note)
  {
    const LinearContactNumbers<double> law = law_of(material);
    Pack                               pushed(0.0);
    for (std::size_t l = begin; l < end; l += pack_size)
      {
        const Ends         ends(pairs, pose, cell, l);
        const Pack         length    = square_root(dot(ends.branch, ends.branch));
        const Vec<Pack, 3> direction = (Pack(1.0) / length) * ends.branch, arm = Pack(0.5) * ends.branch;
        const Vec<Pack, 3> slip  = (ends.branch - read(pairs.branch, l)) - cross(ends.turns, arm);
        Vec<Pack, 3>       shear = across(direction, multiply_add(Pack(1 / reference), slip, read(pairs.shear, l)));
        LinkWork<Pack>     unused;
        const auto answer = linear_contact_force(law, Pack(1 / reference) * (length - Pack(reference)), Pack(area),
                                                 Pack(reference), slip, shear, unused);
        write(pairs.branch, l, ends.branch);
        write(pairs.shear, l, shear);
        note(l, answer.normal, length);
        pushed                    = negative_multiply_add(answer.normal, length, pushed);
        const Vec<Pack, 3> pull   = multiply_add(answer.normal, direction, answer.shear),
                           couple = cross(arm, answer.shear);
        Pack records[8]           = {pull[0], pull[1], pull[2], couple[0], couple[1], couple[2], Pack(0.0), Pack(0.0)};
        transpose(records);
        for (std::size_t lane = 0; lane < pack_size; ++lane)
          store(records[lane], &force[record_size * (l + lane)]);
      }
    return pushed;
  }

  void FrictionalAssembly::move(const double strain)
  {
    std::vector<double> largest(blocks_of(share.own(), spheres_in_block));
#pragma omp parallel for schedule(static) if (share.own() > worth_threads)
    for (std::size_t b = 0; b < largest.size(); ++b)
      largest[b] = block_motion(b, 1 + strain);
    share.receive(pose);
    double farthest = 0;
    for (const double of_block : largest)
      farthest = std::max(farthest, of_block);
    cell.set_gradient(strain / material.time_step * Eigen::Matrix3d::Identity());
    cell.advance(material.time_step);
    pairs.follow(pose, cell, 1 + strain, std::sqrt(share.largest(farthest)));
  }

  double FrictionalAssembly::block_motion(const std::size_t block, const double growth)
  {
    const Pack        signs = load(difference_and_sum), masses = load(inverse_inertias), centre = load(of_centre);
    const Pack        kept = Pack(growth) * centre, step(material.time_step);
    Pack              largest(0.0);
    const Plates      plates(edges());
    const std::size_t begin = block * spheres_in_block, end = std::min(begin + spheres_in_block, share.own());
    for (std::size_t i = begin; i < end; ++i)
      {
        Pack sum = material.plates ? plates.push(&pose[record_size * i]) : Pack(0.0);
        for (std::int32_t l = pairs.own_begin[i]; l < pairs.own_begin[i + 1]; ++l)
          sum = sum + load(&force[record_size * static_cast<std::size_t>(l)]);
        for (std::int32_t o = pairs.other_begin[i]; o < pairs.other_begin[i + 1]; ++o)
          sum = multiply_add(signs, load(&force[record_size * static_cast<std::size_t>(pairs.others[o])]), sum);
        const std::size_t at   = record_size * i;
        const Pack        now  = load(&velocity[at]);
        const Pack        next = now + step * damped(sum * masses, now, material.time_step, material.damping),
                   moved       = step * next;
        store(next, &velocity[at]);
        store(kept * load(&pose[at]) + moved, &pose[at]);
        largest = maximum(largest, moved * moved * centre);
      }
    return 3 * largest_of(largest);
  }

  std::vector<Eigen::Vector3d> FrictionalAssembly::unbalanced_forces(double &pushing, double &contacts) const
  {
    std::vector<Eigen::Vector3d> unbalanced(share.own(), Eigen::Vector3d::Zero());
    std::vector<double>          sizes; // of what is added up in the order of all
    const auto                   push = [&](const std::int32_t record, const Eigen::Vector3d &pull) {
      if (const auto sphere = static_cast<std::size_t>(record); sphere < share.own())
        unbalanced[sphere] += pull;
    };
    const auto own_first = pairs.own().first;
    for (const auto &lines : {pairs.copies(), pairs.own()})
      for (std::size_t l = lines.first; l < lines.second; ++l)
        {
          const Eigen::Vector3d pull(&force[record_size * l]);
          const double          size = pull.norm();
          if (size == 0)
            continue;
          push(pairs.first[l], pull);
          push(pairs.second[l], -pull);
          if (l >= own_first)
            sizes.push_back(size);
        }
    double numbers[] = {0, 0};
    share.in_turn(numbers, std::size(numbers), [&] {
      for (const double size : sizes)
        numbers[0] += size;
      numbers[1] += static_cast<double>(sizes.size());
    });
    pushing  = numbers[0];
    contacts = numbers[1];
    return unbalanced;
  }

  AssemblyMeasures FrictionalAssembly::measures() const
  {
    double                       pushing = 0, contacts = 0;
    std::vector<Eigen::Vector3d> unbalanced = unbalanced_forces(pushing, contacts);
    double                       numbers[]  = {pushing, contacts, 0};
    double                      &pushed = numbers[0], &touching = numbers[1], &sum = numbers[2];
    const auto                   push_by_plates = [&, plates = Plates(edges())](const std::size_t i) {
      alignas(64) Record push[2];
      store(plates.in_low(&pose[record_size * i]), push[0]);
      store(plates.in_high(&pose[record_size * i]), push[1]);
      unbalanced[i] += Eigen::Vector3d(push[0]) - Eigen::Vector3d(push[1]);
      for (const Record &of_side : push)
        for (int d = 0; d < 3; ++d)
          {
            pushed += of_side[d];
            touching += of_side[d] > 0;
          }
    };
    share.in_turn(numbers, std::size(numbers), [&] {
      for (std::size_t i = 0; i < share.own(); ++i)
        {
          if (material.plates)
            push_by_plates(i);
          sum += unbalanced[i].norm();
        }
    });
    const double ratio = touching == 0 ? std::numeric_limits<double>::infinity() :
                                         sum / static_cast<double>(share.all()) / (pushed / touching);
    return {pressure, ratio, static_cast<std::int64_t>(contacts)};
  }

  double FrictionalAssembly::mean_overlap() const
  {
    double  numbers[] = {0, 0};
    double &sum = numbers[0], &contacts = numbers[1];
    share.in_turn(numbers, std::size(numbers), [&] {
      for (std::size_t l = pairs.own().first; l < pairs.own().second; ++l)
        {
          const double overlap = 2 - Eigen::Vector3d(pairs.branch[0][l], pairs.branch[1][l], pairs.branch[2][l]).norm();
          if (overlap <= 0)
            continue;
          ++contacts;
          sum += overlap;
        }
    });
    return contacts == 0 ? 0.0 : sum / contacts;
  }

  std::vector<Eigen::Vector3d> FrictionalAssembly::centres() const
  {
    const Eigen::Vector3d              box = edges();
    std::vector<Eigen::Vector3d>       result(share.all());
    const std::vector<Eigen::Vector3d> places = share.all_places(pose);
    for (std::size_t i = 0; i < places.size(); ++i)
      {
        const Eigen::Vector3d &x = places[i];
        for (int d = 0; d < 3; ++d)
          result[static_cast<std::size_t>(order[i])][d] =
            material.plates ? x[d] : x[d] - box[d] * std::floor(x[d] / box[d]);
      }
    return result;
  }
} // namespace dem
