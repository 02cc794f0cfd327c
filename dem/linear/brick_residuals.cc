#include "dem/linear/brick_residuals.h"

#include "dem/core/simd.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    /** Numbers of a brick: whole packs, zero where there are fewer rows. */
    constexpr std::int64_t brick_size = static_cast<std::int64_t>(particles_per_brick) * motions;
    static_assert(brick_size % pack_size == 0, "a brick consists of whole packs");

    double product(const double *const a, const double *const b)
    {
      Pack sum = 0.0;
      for (std::int64_t i = 0; i < brick_size; i += pack_size)
        sum = multiply_add(load(a + i), load(b + i), sum);
      return sum_of(sum);
    }

    void subtract(const double part, const double *const a, double *const from)
    {
      for (std::int64_t i = 0; i < brick_size; i += pack_size)
        store(negative_multiply_add(Pack(part), load(a + i), load(from + i)), from + i);
    }
  } // namespace

  BrickResiduals::BrickResiduals(RowShare &shared, const std::size_t number)
    : share(shared)
    , rows(number)
    , first_brick(share.own().first / static_cast<std::int64_t>(particles_per_brick))
    , bricks((share.own().end - share.own().first + static_cast<std::int64_t>(particles_per_brick) - 1) /
             static_cast<std::int64_t>(particles_per_brick))
    , w(static_cast<std::size_t>(bricks * brick_size), 0.0)
    , z(number * motions, 0.0)
  {
  }

  Eigen::VectorXd BrickResiduals::products(const int vectors) const
  {
    const std::size_t all     = (rows + particles_per_brick - 1) / particles_per_brick;
    const auto        numbers = static_cast<std::size_t>(vectors) + 1;
    base::Column      sums(all * numbers);
#pragma omp parallel for schedule(static)
    for (std::int64_t brick = 0; brick < bricks; ++brick)
      {
        const double *const own = w.data() + brick * brick_size;
        double *const       to  = &sums[static_cast<std::size_t>(first_brick + brick) * numbers];
        for (int j = 0; j < vectors; ++j)
          to[j] = product(basis[static_cast<std::size_t>(j)].data() + brick * brick_size, own);
        to[vectors] = product(own, own);
      }
    share.gather(sums, static_cast<std::int64_t>(particles_per_brick), numbers);
    Eigen::VectorXd total = Eigen::VectorXd::Zero(vectors + 1);
    for (std::size_t brick = 0; brick < all; ++brick)
      total += Eigen::Map<const Eigen::VectorXd>(&sums[brick * numbers], vectors + 1);
    return total;
  }

  double BrickResiduals::norm_of_w() const { return std::sqrt(products(0)[0]); }

  void BrickResiduals::take_out(const Eigen::VectorXd &parts)
  {
#pragma omp parallel for schedule(static)
    for (std::int64_t brick = 0; brick < bricks; ++brick)
      for (Eigen::Index j = 0; j < parts.size(); ++j)
        subtract(parts[j], basis[static_cast<std::size_t>(j)].data() + brick * brick_size,
                 w.data() + brick * brick_size);
  }

  /** @return norm of what is left of w, which then is the next of the basis */
  double BrickResiduals::orthogonalise(const int k)
  {
    // Gram-Schmidt, repeated where much was taken away, as in MinimalResiduals.
    const Eigen::VectorXd first  = products(k + 1);
    const double          before = std::sqrt(first[k + 1]);
    auto                  h      = projected.components(k);
    h.head(k + 1)                = first.head(k + 1);
    take_out(first.head(k + 1));
    double norm = norm_of_w();
    if (norm < 0.7 * before)
      {
        const Eigen::VectorXd again = products(k + 1).head(k + 1);
        h.head(k + 1) += again;
        take_out(again);
        norm = norm_of_w();
      }
    h[k + 1] = norm;
    return norm;
  }

  /** w = b - A x. @return its norm */
  double BrickResiduals::residual(const BlockMatrix &matrix, const base::Column &b, base::Column &x)
  {
    share.receive(x);
    const auto first = share.own().first, end = share.own().end;
    matrix.multiply(x.data(), static_cast<int>(first), static_cast<int>(end), w.data());
    const std::int64_t numbers = (end - first) * motions;
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < numbers; ++i)
      w[i] = b[first * motions + i] - w[i];
    return norm_of_w();
  }

  /** From w, whose norm is given. @return directions found */
  int BrickResiduals::run(
    const BlockMatrix &matrix, BrickFactor &factor, const double enough, const int most, const double norm)
  {
    const auto         first = share.own().first, end = share.own().end;
    const std::int64_t numbers = (end - first) * motions, size = bricks * brick_size;
    const auto         keep_w = [&](const int place, const double length) {
      if (static_cast<int>(basis.size()) <= place)
        basis.emplace_back(w.size());
      double *const to = basis[static_cast<std::size_t>(place)].data();
#pragma omp parallel for schedule(static)
      for (std::int64_t i = 0; i < size; ++i)
        to[i] = length > 0 ? w[i] / length : 0.0;
    };
    projected.begin(most, norm);
    keep_w(0, norm);
    for (int k = 0; k < most; ++k)
      {
        if (static_cast<int>(found.size()) <= k)
          found.emplace_back(static_cast<std::size_t>(numbers));
        float *const made = found[static_cast<std::size_t>(k)].data();
        factor.apply(basis[static_cast<std::size_t>(k)].data(), made);
        double *const own = z.data() + first * motions;
#pragma omp parallel for schedule(static)
        for (std::int64_t i = 0; i < numbers; ++i)
          own[i] = static_cast<double>(made[i]);
        share.receive(z);
        matrix.multiply(z.data(), static_cast<int>(first), static_cast<int>(end), w.data());
        const double length = orthogonalise(k);
        if (!(projected.take(k) > enough))
          return k + 1;
        keep_w(k + 1, length);
      }
    return most;
  }

  void BrickResiduals::add_to(base::Column &x, const int used) const
  {
    const Eigen::VectorXd weight  = projected.weights(used);
    const auto            first   = share.own().first;
    const std::int64_t    numbers = (share.own().end - first) * motions;
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < numbers; ++i)
      for (int j = 0; j < used; ++j)
        x[first * motions + i] += weight[j] * static_cast<double>(found[static_cast<std::size_t>(j)][i]);
  }

  ResidualLeft BrickResiduals::solve(const BlockMatrix  &matrix,
                                     BrickFactor        &factor,
                                     const base::Column &b,
                                     const double        tolerance,
                                     const int           most,
                                     base::Column       &x)
  {
    base::Column nothing(x.size(), 0.0);
    const double size = residual(matrix, b, nothing);
    ResidualLeft report{0, 0};
    if (size == 0)
      {
        x = nothing;
        return report;
      }
    double left = residual(matrix, b, x);
    if (!(left < size)) // a start that is worse than none
      {
        x    = nothing;
        left = residual(matrix, b, x);
      }
    for (double before = 2 * size; left > tolerance * size && report.iterations < most && left < before;)
      {
        before         = left;
        const int used = run(matrix, factor, tolerance * size, std::min(restart, most - report.iterations), left);
        report.iterations += used;
        add_to(x, used);
        left = residual(matrix, b, x);
      }
    share.gather(x);
    report.residual = left / size;
    return report;
  }
} // namespace dem
