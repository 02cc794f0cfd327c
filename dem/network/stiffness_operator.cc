#include "dem/network/stiffness_operator.h"

#include "base/voigt.h"
#include "dem/core/simd.h"
#include "dem/core/vector.h"
#include "dem/model/particles.h"
#include "dem/network/loaded_network.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace dem
{
  namespace
  {
    static_assert(load_lanes == pack_size, "a load case is a lane of a pack");

    constexpr std::size_t stride = motions * load_lanes;

    BRECCIA_KERNEL Vec<Pack, 3> load3(const double *from)
    {
      return {{load(from), load(from + load_lanes), load(from + 2 * load_lanes)}};
    }

    BRECCIA_KERNEL Vec<Pack, 3> broadcast(const Eigen::Vector3d &v) { return {{Pack(v[0]), Pack(v[1]), Pack(v[2])}}; }

    /** The strains of all lanes, component by component. */
    struct StrainPacks
    {
      Pack xx, yy, zz, half_yz, half_zx, half_xy;

      explicit StrainPacks(const LaneStrains &strain)
      {
        const auto component = [&](const int c, const double factor) {
          return pack_of([&](const int lane) { return factor * strain[lane][c]; });
        };
        xx      = component(0, 1.0);
        yy      = component(1, 1.0);
        zz      = component(2, 1.0);
        half_yz = component(3, 0.5);
        half_zx = component(4, 0.5);
        half_xy = component(5, 0.5);
      }

      BRECCIA_KERNEL Vec<Pack, 3> operator*(const Eigen::Vector3d &l) const
      {
        const Vec<Pack, 3> branch = broadcast(l);
        return {{dot(Vec<Pack, 3>{{xx, half_xy, half_zx}}, branch), dot(Vec<Pack, 3>{{half_xy, yy, half_yz}}, branch),
                 dot(Vec<Pack, 3>{{half_zx, half_yz, zz}}, branch)}};
      }
    };

    /** Symmetric stiffness times a vector. */
    template <typename Record>
    BRECCIA_KERNEL Vec<Pack, 3> product(const Record &l, const Vec<Pack, 3> &s)
    {
      const auto row = [&](const double x, const double y, const double z) { return dot(Vec<Pack, 3>{{x, y, z}}, s); };
      return {{row(l.c11, l.c12, l.c31), row(l.c12, l.c22, l.c23), row(l.c31, l.c23, l.c33)}};
    }

    Eigen::Matrix3d cross_matrix(const Eigen::Vector3d &v)
    {
      Eigen::Matrix3d m;
      m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
      return m;
    }
  } // namespace

  StiffnessOperator::StiffnessOperator(const ElasticNetwork           &network,
                                       const std::vector<HeldMotions> &held,
                                       const CellFormulation           formulation)
    : begin(network.particles() + 1, 0)
    , masks(network.particles(), 0)
    , numbers(hilbert_order(network.centre))
    , scale(mean_arm(network))
  {
    std::vector<std::int32_t> place(numbers.size());
    centres.reserve(numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k)
      {
        place[numbers[k]] = static_cast<std::int32_t>(k);
        centres.push_back(network.centre[numbers[k]]);
      }

    HeldMotions missing = 0;
    for (int c = 0; c < motions; ++c)
      if (!network.moves(c))
        missing |= HeldMotions(1u << c);
    // Links in the plane never push out of it: masking z and the rotations about x and y would change nothing.
    const HeldMotions never_loaded = network.dimension == 2 ? 0x1c : 0;
    for (std::size_t k = 0; k < numbers.size(); ++k)
      {
        masks[k] = missing | (held.empty() ? HeldMotions(0) : held[numbers[k]]);
        some_held |= (masks[k] & ~never_loaded) != 0;
      }

    records.reserve(network.links.size());
    for (const ElasticLink &l : network.links)
      {
        Record r;
        r.first      = place[l.first];
        r.second     = place[l.second];
        r.n          = l.direction;
        r.macro      = formulation == CellFormulation::fluctuation ? l.branch : l.shift;
        r.arm_first  = l.arm_first / scale;
        r.arm_second = l.arm_second / scale;
        r.number     = static_cast<std::int32_t>(records.size());
        r.set_stiffness(l.stiffness);
        records.push_back(r);
      }
    // The order matters for memory locality only.
    std::stable_sort(records.begin(), records.end(), [](const Record &a, const Record &b) {
      return std::minmax(a.first, a.second) < std::minmax(b.first, b.second);
    });

    const auto carries_moment = [](const ElasticLink &l) { return !l.turning.isZero(0); };
    if (std::any_of(network.links.begin(), network.links.end(), carries_moment))
      for (const Record &r : records)
        {
          turning.push_back(r);
          turning.back().set_stiffness(network.links[r.number].turning / (scale * scale));
        }

    for (const Record &r : records)
      {
        ++begin[r.first + 1];
        ++begin[r.second + 1];
      }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    entries.resize(2 * records.size());
    std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t l = 0; l < records.size(); ++l)
      {
        entries[next[records[l].first]++]  = {static_cast<std::int32_t>(l), 0};
        entries[next[records[l].second]++] = {static_cast<std::int32_t>(l), 1};
      }
  }

  void StiffnessOperator::Record::set_stiffness(const Eigen::Matrix3d &C)
  {
    c11 = C(0, 0), c22 = C(1, 1), c33 = C(2, 2), c23 = C(1, 2), c31 = C(2, 0), c12 = C(0, 1);
  }

  Eigen::Matrix3d StiffnessOperator::Record::stiffness() const
  {
    Eigen::Matrix3d C;
    C << c11, c12, c31, c12, c22, c23, c31, c23, c33;
    return C;
  }

  void StiffnessOperator::set_stiffness(const std::vector<Eigen::Matrix3d> &stiffness)
  {
    for (Record &r : records)
      r.set_stiffness(stiffness[r.number]);
  }

  template <bool strained, bool with_turning>
  void StiffnessOperator::gather(const Fields &x, const LaneStrains &strain, Fields &y, const ParticleRange &of) const
  {
    const StrainPacks   E(strain);
    const double *const values = x.data();
#pragma omp parallel for schedule(static)
    for (std::int64_t i = of.first; i < of.end; ++i)
      {
        Vec<Pack, 3> force = {{0.0, 0.0, 0.0}}, moment = force;
        for (std::int64_t e = begin[i]; e < begin[i + 1]; ++e)
          {
            const Record       &l      = records[entries[e].link];
            const bool          second = entries[e].side != 0;
            const double *const J      = values + stride * l.first;
            const double *const K      = values + stride * l.second;
            const Vec<Pack, 3>  a      = broadcast(l.n);
            const Vec<Pack, 3>  spin   = multiply_add(Pack(l.arm_first), load3(J + 3 * load_lanes),
                                                      Pack(l.arm_second) * load3(K + 3 * load_lanes));
            Vec<Pack, 3>        slip   = load3(K) - load3(J) + cross(a, spin);
            if constexpr (strained)
              slip = slip + E * l.macro;
            const Vec<Pack, 3> f = product(l, slip);
            const Pack         sign(second ? 1.0 : -1.0), arm(second ? l.arm_second : l.arm_first);
            force  = multiply_add(sign, f, force);
            moment = negative_multiply_add(arm, cross(a, f), moment);
            if constexpr (with_turning)
              moment = multiply_add(
                sign, product(turning[entries[e].link], load3(K + 3 * load_lanes) - load3(J + 3 * load_lanes)), moment);
          }
        double *const out = y.data() + stride * i;
        for (int c = 0; c < 3; ++c)
          {
            store(force[c], out + c * load_lanes);
            store(moment[c], out + (3 + c) * load_lanes);
          }
      }
  }

  void StiffnessOperator::apply(const Fields &x, Fields &y) const { apply(x, y, all()); }

  void StiffnessOperator::apply(const Fields &x, Fields &y, const ParticleRange &of) const
  {
    if (turning.empty())
      gather<false, false>(x, LaneStrains(), y, of);
    else
      gather<false, true>(x, LaneStrains(), y, of);
  }

  void StiffnessOperator::apply(const Fields &x, const LaneStrains &strain, Fields &y) const
  {
    if (turning.empty())
      gather<true, false>(x, strain, y, all());
    else
      gather<true, true>(x, strain, y, all());
  }

  void StiffnessOperator::mask(Fields &x, const ParticleRange &of) const
  {
    for (std::int64_t i = of.first; i < of.end; ++i)
      for (int c = 0; c < motions; ++c)
        if (is_held(i, c))
          std::fill_n(&x[(motions * i + c) * load_lanes], load_lanes, 0.0);
  }

  Eigen::Matrix<double, 3, 6>
  StiffnessOperator::slips(const Record &l, const Fields &x, const LaneStrains &strain) const
  {
    using Columns   = Eigen::Map<const Eigen::Matrix<double, 3, load_lanes, Eigen::RowMajor>>;
    const auto part = [&](const std::int32_t i, const int half) {
      return Columns(&x[stride * i + half * 3 * load_lanes]).leftCols<6>();
    };
    Eigen::Matrix<double, 3, 6> s = part(l.second, 0) - part(l.first, 0);
    s += cross_matrix(l.n) * (l.arm_first * part(l.first, 1) + l.arm_second * part(l.second, 1));
    for (int lane = 0; lane < 6; ++lane)
      s.col(lane) += base::strain_tensor(strain[lane]) * l.macro;
    return s;
  }

  Eigen::Matrix<double, 3, 6> StiffnessOperator::turns(const Record &l, const Fields &x) const
  {
    using Columns   = Eigen::Map<const Eigen::Matrix<double, 3, load_lanes, Eigen::RowMajor>>;
    const auto spin = [&](const std::int32_t i) { return Columns(&x[stride * i + 3 * load_lanes]).leftCols<6>(); };
    return spin(l.second) - spin(l.first);
  }

  std::array<double, load_lanes> StiffnessOperator::link_force_norm(const Fields &x, const LaneStrains &strain) const
  {
    const StrainPacks E(strain);
    Pack              sum = 0.0;
    for (const Record &l : records)
      {
        const double *const J = x.data() + stride * l.first;
        const double *const K = x.data() + stride * l.second;
        const Vec<Pack, 3>  spin =
          Pack(l.arm_first) * load3(J + 3 * load_lanes) + Pack(l.arm_second) * load3(K + 3 * load_lanes);
        const Vec<Pack, 3> s = load3(K) - load3(J) + cross(broadcast(l.n), spin) + E * l.macro;
        const Vec<Pack, 3> f = product(l, s);
        sum += dot(f, f);
      }
    std::array<double, load_lanes> norm;
    for (int lane = 0; lane < load_lanes; ++lane)
      norm[lane] = std::sqrt(sum[lane]);
    return norm;
  }

  base::Matrix6 StiffnessOperator::energy_product(const Fields &x, const LaneStrains &strain) const
  {
    base::Matrix6 sum = base::Matrix6::Zero();
    for (const Record &l : records)
      {
        const Eigen::Matrix<double, 3, 6> s = slips(l, x, strain);
        sum.noalias() += s.transpose() * (l.stiffness() * s);
      }
    for (const Record &l : turning)
      {
        const Eigen::Matrix<double, 3, 6> t = turns(l, x);
        sum.noalias() += t.transpose() * (l.stiffness() * t);
      }
    return 0.5 * (sum + sum.transpose());
  }

  StiffnessOperator::LinkBlocks StiffnessOperator::link_blocks(const std::size_t link) const
  {
    const Record         &l = records[link];
    const Eigen::Matrix3d C = l.stiffness();
    // B = [B_J B_K] with slip = B (u_J, phi_J, u_K, phi_K), (3.1)
    Eigen::Matrix<double, 3, 6> B_J, B_K;
    B_J << -Eigen::Matrix3d::Identity(), l.arm_first * cross_matrix(l.n);
    B_K << Eigen::Matrix3d::Identity(), l.arm_second * cross_matrix(l.n);
    const Eigen::Matrix<double, 3, 6> C_K = C * B_K;
    LinkBlocks                        blocks;
    blocks.first  = l.first;
    blocks.second = l.second;
    blocks.JJ     = B_J.transpose() * (C * B_J);
    blocks.JK     = B_J.transpose() * C_K;
    blocks.KK     = B_K.transpose() * C_K;
    if (!turning.empty())
      {
        const Eigen::Matrix3d T = turning[link].stiffness();
        blocks.JJ.bottomRightCorner<3, 3>() += T;
        blocks.JK.bottomRightCorner<3, 3>() -= T;
        blocks.KK.bottomRightCorner<3, 3>() += T;
      }
    return blocks;
  }

  std::vector<Block> StiffnessOperator::diagonal_blocks() const
  {
    std::vector<Block> diagonal(particles(), Block::Zero());
    for (std::size_t l = 0; l < records.size(); ++l)
      {
        const LinkBlocks b = link_blocks(l);
        diagonal[b.first] += b.JJ;
        diagonal[b.second] += b.KK;
        if (b.first == b.second)
          diagonal[b.first] += b.JK + b.JK.transpose();
      }
    return diagonal;
  }
} // namespace dem
