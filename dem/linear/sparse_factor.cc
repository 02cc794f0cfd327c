#include "dem/linear/sparse_factor.h"

#include "base/errors.h"
#include "base/solver_turns.h"
#include "dem/network/particle_groups.h"

#include <Eigen/SparseCore>

#include <cholmod.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace dem
{
  namespace
  {
    using Index = SuiteSparse_long;
    using Lower = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

    /** Numbers of the free motions; -1 where held. */
    std::vector<Index> number_unknowns(const StiffnessOperator &stiffness, Index &count)
    {
      std::vector<Index> unknown(stiffness.particles() * motions);
      count = 0;
      for (std::size_t i = 0; i < stiffness.particles(); ++i)
        for (int c = 0; c < motions; ++c)
          unknown[motions * i + c] = stiffness.is_held(i, c) ? -1 : count++;
      return unknown;
    }

    /** Particles linked to each particle and numbered above it, ascending. */
    std::vector<std::vector<std::int32_t>> upper_neighbours(const StiffnessOperator &stiffness)
    {
      std::vector<std::vector<std::int32_t>> neighbours(stiffness.particles());
      for (std::size_t l = 0; l < stiffness.links(); ++l)
        {
          const auto ends = stiffness.ends(l);
          if (ends.first != ends.second)
            neighbours[std::min(ends.first, ends.second)].push_back(std::max(ends.first, ends.second));
        }
      for (auto &list : neighbours)
        {
          std::sort(list.begin(), list.end());
          list.erase(std::unique(list.begin(), list.end()), list.end());
        }
      return neighbours;
    }

    /** Lower triangle of the particle graph, one entry per pair and diagonal. */
    Lower particle_graph(const std::vector<std::vector<std::int32_t>> &neighbours)
    {
      const Index        n = static_cast<Index>(neighbours.size());
      Lower              graph(n, n);
      std::vector<Index> sizes(n);
      for (Index i = 0; i < n; ++i)
        sizes[i] = 1 + static_cast<Index>(neighbours[i].size());
      graph.reserve(sizes);
      for (Index i = 0; i < n; ++i)
        {
          graph.insert(i, i) = 1;
          for (const std::int32_t j : neighbours[i])
            graph.insert(j, i) = 1;
        }
      graph.makeCompressed();
      return graph;
    }

    /** Pattern of the lower triangle of the stiffness, values zero. */
    Lower stiffness_pattern(const std::vector<std::vector<std::int32_t>> &neighbours,
                            const std::vector<Index>                     &unknown,
                            const Index                                   unknowns)
    {
      std::vector<Index> rows;
      std::vector<Index> begin{0};
      for (std::size_t i = 0; i < neighbours.size(); ++i)
        for (int c = 0; c < motions; ++c)
          {
            if (unknown[motions * i + c] < 0)
              continue;
            const auto add = [&](const std::size_t j, const int first) {
              for (int d = first; d < motions; ++d)
                if (unknown[motions * j + d] >= 0)
                  rows.push_back(unknown[motions * j + d]);
            };
            add(i, c);
            for (const std::int32_t j : neighbours[i])
              add(j, 0);
            begin.push_back(static_cast<Index>(rows.size()));
          }
      const std::vector<double> zeros(rows.size(), 0.0);
      return Eigen::Map<const Lower>(unknowns, unknowns, zeros.size(), begin.data(), rows.data(), zeros.data());
    }

    /**
     * Translations of one particle of each connected part in which nothing is held: supporting it there costs no force, and
     * leaves no rigid translation in the matrix.
     */
    std::vector<Index> supports_of_free_parts(const StiffnessOperator &stiffness, const std::vector<Index> &unknown)
    {
      ParticleGroups parts(stiffness.particles());
      for (std::size_t l = 0; l < stiffness.links(); ++l)
        parts.join(stiffness.ends(l).first, stiffness.ends(l).second);
      std::vector<HeldMotions> held(stiffness.particles(), 0);
      for (std::size_t i = 0; i < stiffness.particles(); ++i)
        for (int c = 0; c < 3; ++c)
          if (unknown[motions * i + c] < 0)
            held[parts.group_of(static_cast<std::int32_t>(i))] |= HeldMotions(1u << c);
      std::vector<Index> supports;
      for (std::size_t i = 0; i < stiffness.particles(); ++i)
        for (int c = 0; c < 3; ++c)
          if (parts.group_of(static_cast<std::int32_t>(i)) == static_cast<std::int32_t>(i) && !(held[i] >> c & 1))
            supports.push_back(unknown[motions * i + c]);
      return supports;
    }

    cholmod_sparse view(Lower &matrix)
    {
      cholmod_sparse v{};
      v.nrow = v.ncol = matrix.cols();
      v.nzmax         = matrix.nonZeros();
      v.p             = matrix.outerIndexPtr();
      v.i             = matrix.innerIndexPtr();
      v.x             = matrix.valuePtr();
      v.stype         = -1;
      v.itype         = CHOLMOD_LONG;
      v.xtype         = CHOLMOD_REAL;
      v.dtype         = CHOLMOD_DOUBLE;
      v.sorted        = 1;
      v.packed        = 1;
      return v;
    }
  } // namespace

  struct SparseFactor::Implementation
  {
    cholmod_common         common;
    cholmod_factor        *factor = nullptr;
    mutable cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr; // kept between solutions
    Lower                  matrix;
    std::vector<Index>     unknown;  // of each motion, -1: held
    std::vector<Index>     supports; // unknowns that take up the rigid translations
    double                 added = 0;

    Implementation()
    {
      cholmod_l_start(&common);
      common.print      = 0; // failures come back as a status, and we say them ourselves
      common.supernodal = CHOLMOD_SUPERNODAL;
      common.final_ll   = 1;
    }

    ~Implementation()
    {
      cholmod_l_free_dense(&x, &common);
      cholmod_l_free_dense(&y, &common);
      cholmod_l_free_dense(&e, &common);
      cholmod_l_free_factor(&factor, &common);
      cholmod_l_finish(&common);
    }
    Implementation(const Implementation &)            = delete;
    Implementation &operator=(const Implementation &) = delete;

    [[noreturn]] void refuse(const std::string &what) const
    {
      throw base::NumericalError("static solution, direct: " + what + " (" + std::to_string(matrix.cols()) +
                                 " unknowns, CHOLMOD status " + std::to_string(common.status) +
                                 "). The iterative solver needs far less memory.");
    }

    /** Fill-reducing order of the unknowns: best of CHOLMOD's choices for the particle graph, spread over the motions. */
    std::vector<Index> order(Lower graph)
    {
      const auto      turn     = base::ordering_turn();
      cholmod_sparse  pattern  = view(graph);
      cholmod_factor *symbolic = cholmod_l_analyze(&pattern, &common);
      if (!symbolic)
        refuse("the particles could not be ordered");
      std::vector<Index> permutation;
      permutation.reserve(matrix.cols());
      for (Index k = 0; k < graph.cols(); ++k)
        {
          const Index particle = static_cast<const Index *>(symbolic->Perm)[k];
          for (int c = 0; c < motions; ++c)
            if (unknown[motions * particle + c] >= 0)
              permutation.push_back(unknown[motions * particle + c]);
        }
      cholmod_l_free_factor(&symbolic, &common);
      return permutation;
    }

    void add_block(const std::int32_t i, const std::int32_t j, const Block &block)
    {
      // Row of motion d of i, column of motion c of j; the lower triangle only.
      for (int c = 0; c < motions; ++c)
        for (int d = 0; d < motions; ++d)
          {
            const Index row = unknown[motions * i + d], column = unknown[motions * j + c];
            if (row >= column && column >= 0)
              matrix.coeffRef(row, column) += block(d, c);
          }
    }

    void assemble(const StiffnessOperator &stiffness)
    {
      std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
      const std::vector<Block> diagonal = stiffness.diagonal_blocks();
      for (std::size_t i = 0; i < diagonal.size(); ++i)
        add_block(i, i, diagonal[i]);
      for (std::size_t l = 0; l < stiffness.links(); ++l)
        {
          const auto b = stiffness.link_blocks(l);
          if (b.first > b.second)
            add_block(b.first, b.second, b.JK);
          else if (b.first < b.second)
            add_block(b.second, b.first, b.JK.transpose());
        }
    }
  };

  SparseFactor::SparseFactor(const StiffnessOperator &stiffness)
    : self(std::make_unique<Implementation>())
  {
    const auto neighbours = upper_neighbours(stiffness);
    Index      unknowns   = 0;
    self->unknown         = number_unknowns(stiffness, unknowns);
    self->supports        = supports_of_free_parts(stiffness, self->unknown);
    self->matrix          = stiffness_pattern(neighbours, self->unknown, unknowns);

    std::vector<Index> permutation  = self->order(particle_graph(neighbours));
    self->common.nmethods           = 1;
    self->common.method[0].ordering = CHOLMOD_GIVEN;
    cholmod_sparse pattern          = view(self->matrix);
    self->factor                    = cholmod_l_analyze_p(&pattern, permutation.data(), nullptr, 0, &self->common);
    if (!self->factor)
      self->refuse("the factor could not be laid out");
  }

  SparseFactor::~SparseFactor() = default;

  FactorCost SparseFactor::cost() const { return {self->common.fl, 8.0 * static_cast<double>(self->factor->xsize)}; }

  double SparseFactor::added() const { return self->added; }

  void SparseFactor::factorise(const StiffnessOperator &stiffness)
  {
    Implementation &s = *self;
    s.assemble(stiffness);
    const Eigen::VectorXd diagonal = s.matrix.diagonal();
    const double          mean     = diagonal.mean();
    cholmod_sparse        view_of  = view(s.matrix);
    const auto            turn     = base::dense_kernels_turn();
    for (const double part : {1e-10, 1e-8, 1e-6})
      {
        // A motion that nothing holds gets an ordinary stiffness: it is not loaded, and stays where it is.
        for (Index i = 0; i < s.matrix.cols(); ++i)
          s.matrix.coeffRef(i, i) = diagonal[i] > 1e-14 * mean ? diagonal[i] * (1 + part) : mean;
        for (const Index i : s.supports)
          s.matrix.coeffRef(i, i) += mean;
        s.added = part;
        if (!cholmod_l_factorize(&view_of, s.factor, &s.common))
          s.refuse("the factorisation did not run");
        if (s.common.status == CHOLMOD_OK)
          return;
      }
    s.refuse("the stiffness is not positive semi-definite");
  }

  void SparseFactor::apply(const Fields &r, Fields &z) const
  {
    Implementation                                   &s = *self;
    const Index                                       n = s.matrix.cols();
    Eigen::Matrix<double, Eigen::Dynamic, load_lanes> b(n, load_lanes);
    for (std::size_t k = 0; k < s.unknown.size(); ++k)
      if (s.unknown[k] >= 0)
        b.row(s.unknown[k]) = Eigen::Map<const Eigen::Matrix<double, 1, load_lanes>>(&r[k * load_lanes]);

    cholmod_dense right{};
    right.nrow = right.d = n;
    right.ncol           = load_lanes;
    right.nzmax          = n * load_lanes;
    right.x              = b.data();
    right.xtype          = CHOLMOD_REAL;
    right.dtype          = CHOLMOD_DOUBLE;
    const auto turn      = base::dense_kernels_turn();
    if (!cholmod_l_solve2(CHOLMOD_A, s.factor, &right, nullptr, &s.x, nullptr, &s.y, &s.e, &s.common))
      s.refuse("the solution did not run");

    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, load_lanes>> x(static_cast<double *>(s.x->x), n,
                                                                                load_lanes);
    std::fill(z.begin(), z.end(), 0.0);
    for (std::size_t k = 0; k < s.unknown.size(); ++k)
      if (s.unknown[k] >= 0)
        for (int lane = 0; lane < load_lanes; ++lane)
          z[k * load_lanes + lane] = x(s.unknown[k], lane);
  }
} // namespace dem
