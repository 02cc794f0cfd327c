#include "dem/linear/rigid_groups.h"

#include "base/errors.h"
#include "base/solver_turns.h"
#include "dem/core/simd.h"
#include "dem/core/vector.h"
#include "dem/network/particle_groups.h"
#include "dem/network/slip_matrices.h"

#include <Eigen/CholmodSupport>

#include <algorithm>
#include <string>
#include <utility>

namespace dem
{
  namespace
  {
    constexpr std::int64_t smallest_group =
      128; ///< particles; fewer spare iterations, and make each of them dearer than that gains
    constexpr std::int64_t most_groups = 2000; ///< its factor then takes tens of MB
    /** Of the diagonal, added to it: the network's own rigid motion has no stiffness. */
    constexpr double kept_definite_by = 1e-10;

    using Sparse = Eigen::SparseMatrix<double>;

    std::int64_t particles_of_group(const std::int64_t particles)
    {
      std::int64_t group = smallest_group;
      while ((particles + group - 1) / group > most_groups)
        group *= 2;
      return group;
    }

    /** Lower triangle. */
    Sparse lower_triangle(const BlockMatrix &matrix)
    {
      std::vector<Eigen::Triplet<double>> entries;
      for (int row = 0; row < matrix.rows(); ++row)
        for (int k = matrix.begin(row); k < matrix.begin(row + 1) && matrix.column(k) <= row; ++k)
          for (int c = 0; c < motions; ++c)
            for (int r = 0; r < motions; ++r)
              if (matrix.column(k) < row || c <= r)
                entries.emplace_back(motions * row + r, motions * matrix.column(k) + c, matrix.block(k)(r, c));
      Sparse lower(matrix.size(), matrix.size());
      lower.setFromTriplets(entries.begin(), entries.end());
      return lower;
    }

    void keep_regular(Sparse &lower)
    {
      const Eigen::VectorXd diagonal = lower.diagonal();
      const double          mean     = diagonal.mean();
      for (Eigen::Index i = 0; i < lower.cols(); ++i)
        lower.coeffRef(i, i) = diagonal[i] > 1e-12 * mean ? diagonal[i] * (1 + kept_definite_by) : mean;
    }

    BRECCIA_KERNEL Vec<Pack, 3> broadcast(const Eigen::Vector3d &v) { return {{Pack(v[0]), Pack(v[1]), Pack(v[2])}}; }

    /** A particle's motions or forces in all lanes. */
    struct SixPacks
    {
      Pack of[motions];

      static SixPacks from(const double *const field)
      {
        SixPacks all;
        for (int c = 0; c < motions; ++c)
          all.of[c] = load(field + c * load_lanes);
        return all;
      }
      Vec<Pack, 3> upper() const { return {{of[0], of[1], of[2]}}; }
      Vec<Pack, 3> lower() const { return {{of[3], of[4], of[5]}}; }
    };

    SixPacks operator*(const Block &block, const SixPacks &x)
    {
      SixPacks y;
      for (int row = 0; row < motions; ++row)
        {
          y.of[row] = block(row, 0) * x.of[0];
          for (int c = 1; c < motions; ++c)
            y.of[row] = multiply_add(Pack(block(row, c)), x.of[c], y.of[row]);
        }
      return y;
    }
  } // namespace

  struct RigidGroups::Factor : Eigen::CholmodSupernodalLLT<Sparse, Eigen::Lower>
  {
    double numbers() const { return static_cast<double>(m_cholmodFactor->xsize); }
  };

  RigidGroups::RigidGroups(const StiffnessOperator &stiffness, const RowShare &shared)
    : share(shared)
    , particles(static_cast<std::int64_t>(stiffness.particles()))
    , of_group(particles_of_group(particles))
    , groups((particles + of_group - 1) / of_group)
    , arm(stiffness.places())
    , partly(stiffness.particles())
    , factor(std::make_unique<Factor>())
  {
    for (std::int64_t first = 0; first < particles; first += of_group)
      {
        const std::int64_t end    = std::min(first + of_group, particles);
        Eigen::Vector3d    middle = Eigen::Vector3d::Zero();
        for (std::int64_t i = first; i < end; ++i)
          middle += arm[i];
        middle /= static_cast<double>(end - first);
        for (std::int64_t i = first; i < end; ++i)
          arm[i] = (arm[i] - middle) / stiffness.length_scale();
      }
    find_resisted(stiffness);
    Sparse matrix = lower_triangle(*condense(stiffness));
    keep_regular(matrix);
    factor->cholmod().print = 0;
    {
      const auto turn = base::ordering_turn();
      factor->analyzePattern(matrix);
    }
    const auto turn = base::dense_kernels_turn();
    factor->factorize(matrix);
    if (factor->info() != Eigen::Success)
      throw base::NumericalError(
        "static solution: the stiffness is not positive semi-definite, by the rigid motions of " +
        std::to_string(groups) + " groups of particles.");
  }

  RigidGroups::~RigidGroups() = default;

  double RigidGroups::operations() const { return 4.0 * load_lanes * factor->numbers(); }

  std::vector<std::uint8_t> RigidGroups::take_part(const StiffnessOperator &stiffness) const
  {
    ParticleGroups parts(stiffness.particles());
    for (std::size_t l = 0; l < stiffness.links(); ++l)
      parts.join(stiffness.ends(l).first, stiffness.ends(l).second);
    std::vector<std::int64_t> members(stiffness.particles(), 0);
    for (std::int64_t i = 0; i < particles; ++i)
      ++members[parts.group_of(static_cast<std::int32_t>(i))];
    std::vector<std::uint8_t> part(stiffness.particles());
    for (std::int64_t i = 0; i < particles; ++i)
      part[i] = members[parts.group_of(static_cast<std::int32_t>(i))] >= of_group;
    return part;
  }

  void RigidGroups::find_resisted(const StiffnessOperator &stiffness)
  {
    const std::vector<std::uint8_t> part       = take_part(stiffness);
    const std::vector<Block>        diagonal   = stiffness.diagonal_blocks();
    const auto                      projection = [&](const std::int64_t i) -> Block {
      if (!part[i])
        return Block::Zero();
      return particle_inverse(stiffness, diagonal[i], i) * diagonal[i];
    };
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < particles; ++i)
      {
        Block whole = Block::Identity();
        // What does not exist in the plane is never loaded, and never moves.
        for (int c = 0; c < motions && !stiffness.anything_held(); ++c)
          if (stiffness.is_held(i, c))
            whole(c, c) = 0;
        partly[i] = !(projection(i) - whole).isZero(1e-6);
      }
    for (std::int64_t i = 0; i < particles; ++i)
      if (partly[i])
        resisted.emplace(i, projection(i));
  }

  Block RigidGroups::rigid(const std::int64_t particle) const
  {
    Block all                  = Block::Identity();
    all.topRightCorner<3, 3>() = -cross_product_matrix(arm[particle]);
    return partly[particle] ? Block(resisted.at(particle) * all) : all;
  }

  std::unique_ptr<BlockMatrix> RigidGroups::condense(const StiffnessOperator &stiffness) const
  {
    std::vector<std::pair<int, int>> joined;
    for (std::size_t l = 0; l < stiffness.links(); ++l)
      {
        const auto [first, second] = stiffness.ends(l);
        if (group_of(first) != group_of(second))
          joined.emplace_back(group_of(first), group_of(second));
      }
    auto matrix = std::make_unique<BlockMatrix>(static_cast<int>(groups), joined);
    matrix->set_zero();
    for (std::size_t l = 0; l < stiffness.links(); ++l)
      {
        const StiffnessOperator::LinkBlocks link = stiffness.link_blocks(l);
        const Block                         R_J = rigid(link.first), R_K = rigid(link.second);
        const int                           J = group_of(link.first), K = group_of(link.second);
        const Block                         JJ = R_J.transpose() * link.JJ * R_J, JK = R_J.transpose() * link.JK * R_K,
                    KK = R_K.transpose() * link.KK * R_K;
        matrix->block(matrix->diagonal(J)) += JJ;
        matrix->block(matrix->diagonal(K)) += KK;
        if (J >= K)
          matrix->block(matrix->place(J, K)) += JK;
        if (J <= K)
          matrix->block(matrix->place(K, J)) += JK.transpose();
      }
    return matrix;
  }

  Eigen::MatrixXd RigidGroups::on_groups(const Fields &r) const
  {
    // Bricks, which no boundary between ranks divides, or smaller groups.
    const auto             brick  = static_cast<std::int64_t>(particles_per_brick);
    const std::int64_t     of_sum = std::min(of_group, brick), sums = (particles + of_sum - 1) / of_sum;
    constexpr std::int64_t size = motions * load_lanes;
    base::Column           sum(static_cast<std::size_t>(sums * size));
    const ParticleRange    own = share.own();
    const std::int64_t     end = own.first == own.end ? 0 : (own.end + of_sum - 1) / of_sum;
#pragma omp parallel for schedule(static)
    for (std::int64_t s = own.first / of_sum; s < end; ++s)
      {
        SixPacks all{};
        for (std::int64_t i = s * of_sum; i < std::min((s + 1) * of_sum, own.end); ++i)
          {
            SixPacks forces = SixPacks::from(&r[size * i]);
            if (partly[i])
              forces = resisted.at(i).transpose() * forces;
            const Vec<Pack, 3> torque = cross(broadcast(arm[i]), forces.upper()) + forces.lower();
            for (int c = 0; c < 3; ++c)
              {
                all.of[c] += forces.of[c];
                all.of[c + 3] += torque[c];
              }
          }
        for (int c = 0; c < motions; ++c)
          store(all.of[c], &sum[size * s + c * load_lanes]);
      }
    share.gather(sum, of_sum, size);
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(motions * groups, load_lanes);
    using Rows             = Eigen::Map<const Eigen::Matrix<double, motions, load_lanes, Eigen::RowMajor>>;
    for (std::int64_t s = 0; s < sums; ++s)
      forces.middleRows<motions>(motions * (s * of_sum / of_group)) += Rows(&sum[size * s]);
    return forces;
  }

  void RigidGroups::add_answer(const Fields &r, Fields &z) const
  {
    const Eigen::MatrixXd forces = on_groups(r);
    base::Column          moved(forces.size());
    {
      const auto turn = base::dense_kernels_turn();
      Eigen::Map<Eigen::Matrix<double, -1, load_lanes, Eigen::RowMajor>>(moved.data(), forces.rows(), load_lanes) =
        factor->solve(forces);
    }
    constexpr std::int64_t size = motions * load_lanes;
#pragma omp parallel for schedule(static)
    for (std::int64_t i = share.own().first; i < share.own().end; ++i)
      {
        const SixPacks     group = SixPacks::from(&moved[size * group_of(i)]);
        const Vec<Pack, 3> shift = group.upper() - cross(broadcast(arm[i]), group.lower());
        SixPacks           all{{shift[0], shift[1], shift[2], group.of[3], group.of[4], group.of[5]}};
        if (partly[i])
          all = resisted.at(i) * all;
        for (int c = 0; c < motions; ++c)
          store(load(&z[size * i + c * load_lanes]) + all.of[c], &z[size * i + c * load_lanes]);
      }
  }
} // namespace dem
