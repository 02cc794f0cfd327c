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
    , z{base::Column(number * motions, 0.0), {}}
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
    if (border_w.size() == 0)
      return total;
    for (int j = 0; j < vectors; ++j)
      total[j] += border_basis[static_cast<std::size_t>(j)].dot(border_w);
    total[vectors] += border_w.squaredNorm();
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
    for (Eigen::Index j = 0; j < parts.size() && border_w.size() > 0; ++j)
      border_w -= parts[j] * border_basis[static_cast<std::size_t>(j)];
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

  /** w = A x. */
  void BrickResiduals::multiply(const BrickSystem &system, BrickVector &x)
  {
    share.receive(x.rows);
    system.matrix.multiply(x.rows.data(), static_cast<int>(share.own().first), static_cast<int>(share.own().end),
                           w.data());
    if (system.border)
      system.border->multiply(x.rows, x.border, w.data(), border_w);
  }

  /** w = b - A x. @return its norm */
  double BrickResiduals::residual(const BrickSystem &system, const BrickVector &b, BrickVector &x)
  {
    multiply(system, x);
    const auto         first   = share.own().first;
    const std::int64_t numbers = (share.own().end - first) * motions;
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < numbers; ++i)
      w[i] = b.rows[first * motions + i] - w[i];
    if (system.border)
      border_w = b.border - border_w;
    return norm_of_w();
  }

  /** Make w, over its length, one of the basis. */
  void BrickResiduals::keep_w(const int place, const double length)
  {
    const std::int64_t size = bricks * brick_size;
    const auto         at   = static_cast<std::size_t>(place);
    if (basis.size() <= at)
      {
        basis.emplace_back(w.size());
        border_basis.emplace_back();
      }
    double *const to = basis[at].data();
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < size; ++i)
      to[i] = length > 0 ? w[i] / length : 0.0;
    border_basis[at] = length > 0 ? Eigen::VectorXd(border_w / length) : Eigen::VectorXd::Zero(border_w.size());
  }

  /** From w, whose norm is given. @return directions found */
  int BrickResiduals::run(const BrickSystem &system, const double enough, const int most, const double norm)
  {
    const auto         first   = share.own().first;
    const std::int64_t numbers = (share.own().end - first) * motions;
    projected.begin(most, norm);
    keep_w(0, norm);
    for (int k = 0; k < most; ++k)
      {
        const auto at = static_cast<std::size_t>(k);
        if (found.size() <= at)
          {
            found.emplace_back(static_cast<std::size_t>(numbers));
            border_found.emplace_back();
          }
        float *const made = found[at].data();
        system.factor.apply(basis[at].data(), made, border_basis[at], z.border);
        double *const own = z.rows.data() + first * motions;
#pragma omp parallel for schedule(static)
        for (std::int64_t i = 0; i < numbers; ++i)
          own[i] = static_cast<double>(made[i]);
        border_found[at] = z.border;
        multiply(system, z);
        const double length = orthogonalise(k);
        if (!(projected.take(k) > enough))
          return k + 1;
        keep_w(k + 1, length);
      }
    return most;
  }

  void BrickResiduals::add_to(BrickVector &x, const int used) const
  {
    const Eigen::VectorXd weight  = projected.weights(used);
    const auto            first   = share.own().first;
    const std::int64_t    numbers = (share.own().end - first) * motions;
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < numbers; ++i)
      for (int j = 0; j < used; ++j)
        x.rows[first * motions + i] += weight[j] * static_cast<double>(found[static_cast<std::size_t>(j)][i]);
    for (int j = 0; j < used && x.border.size() > 0; ++j)
      x.border += weight[j] * border_found[static_cast<std::size_t>(j)];
  }

  ResidualLeft BrickResiduals::solve(
    const BrickSystem &system, const BrickVector &b, const double tolerance, const int most, BrickVector &x)
  {
    BrickVector  nothing{base::Column(x.rows.size(), 0.0), Eigen::VectorXd::Zero(x.border.size())};
    const double size = residual(system, b, nothing);
    ResidualLeft report{0, 0};
    if (size == 0)
      {
        x = nothing;
        return report;
      }
    double left = residual(system, b, x);
    if (!(left < size)) // a start that is worse than none
      {
        x    = nothing;
        left = residual(system, b, x);
      }
    for (double before = 2 * size; left > tolerance * size && report.iterations < most && left < before;)
      {
        before         = left;
        const int used = run(system, tolerance * size, std::min(restart, most - report.iterations), left);
        report.iterations += used;
        add_to(x, used);
        left = residual(system, b, x);
      }
    share.gather(x.rows);
    report.residual = left / size;
    return report;
  }
} // namespace dem
