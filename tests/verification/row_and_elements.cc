#include "tests/verification/row_and_elements.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace row_and_elements
{
  using Eigen::Index;
  using Eigen::MatrixXd;
  using Eigen::VectorXd;

  namespace
  {
    constexpr double pi = 3.14159265358979323846;

    /** Points of a line with springs between neighbours. */
    struct Line
    {
      VectorXd place, mass, spring, displacement, velocity;

      explicit Line(const VectorXd &places)
        : place(places)
        , mass(VectorXd::Ones(places.size()))
        , spring(VectorXd::Ones(places.size() - 1))
        , displacement(VectorXd::Zero(places.size()))
        , velocity(VectorXd::Zero(places.size()))
      {
      }

      void kick(const double time)
      {
        const Index    n    = place.size();
        const VectorXd pull = spring.cwiseProduct(displacement.tail(n - 1) - displacement.head(n - 1));
        velocity.head(n - 1) += time * pull.cwiseQuotient(mass.head(n - 1));
        velocity.tail(n - 1) -= time * pull.cwiseQuotient(mass.tail(n - 1));
      }

      /** Of the first so many points, with displacements and velocities less those of another line. */
      double energy(const Index points, const Line *less = nullptr) const
      {
        VectorXd u = displacement.head(points), v = velocity.head(points);
        if (less)
          {
            u -= less->displacement.head(points);
            v -= less->velocity.head(points);
          }
        const VectorXd stretch = u.tail(points - 1) - u.head(points - 1);
        return 0.5 * mass.head(points).dot(v.cwiseAbs2()) + 0.5 * spring.head(points - 1).dot(stretch.cwiseAbs2());
      }
    };

    struct Packet
    {
      double number, frequency, speed, width, centre;

      explicit Packet(const double wavelength)
        : number(2 * pi / wavelength)
        , frequency(2 * std::sin(number / 2))
        , speed(std::cos(number / 2))
        , width((wavelength > 48 ? 2 : 3) * wavelength)
        , centre(-4.2 * width)
      {
      }

      double at(const double place, const double time) const
      {
        const double off = (place - centre - speed * time) / width;
        return std::exp(-off * off) * std::cos(number * (place - centre) - frequency * time);
      }

      void start(Line &line, const double step) const
      {
        for (Index i = 0; i < line.place.size(); ++i)
          {
            line.displacement[i] = at(line.place[i], 0);
            line.velocity[i]     = (line.displacement[i] - at(line.place[i], -step)) / step; // half a step earlier
          }
      }
    };

    /** N: what the first nodes are at the tied particles, the last ones of the row. */
    MatrixXd shape_of(const Row &row)
    {
      const Index tied  = row.overlap * row.element + 1;
      MatrixXd    shape = MatrixXd::Zero(tied, row.overlap + 1);
      for (Index k = 0; k < tied; ++k)
        {
          const Index  e  = std::min<Index>(k / row.element, row.overlap - 1);
          const double in = static_cast<double>(k - e * row.element) / row.element;
          shape(k, e)     = 1 - in;
          shape(k, e + 1) = in;
        }
      return shape;
    }

    /** What ties the last particles to the first nodes: v - m^-1 B^T l, V + M^-1 (B N)^T l with l = A^-1 B (v - N V). */
    struct Tie
    {
      MatrixXd shape, of_particles, of_nodes; ///< N; what velocities change by for each unlike velocity

      Tie(const Row &row, const Line &particles, const Line &nodes)
      {
        shape            = shape_of(row);
        const Index tied = shape.rows(), corners = shape.cols();
        VectorXd    counted = VectorXd::Ones(tied);
        if (row.sides_half)
          counted[0] = counted[tied - 1] = 0.5;
        const MatrixXd rows   = row.ties == Ties::coarse ? MatrixXd(shape.transpose() * counted.asDiagonal()) :
                                                           MatrixXd::Identity(tied, tied);
        const MatrixXd light  = particles.mass.tail(tied).cwiseInverse().asDiagonal() * rows.transpose(),
                       coarse = nodes.mass.head(corners).cwiseInverse().asDiagonal() * (rows * shape).transpose();
        const MatrixXd system = rows * light + rows * shape * coarse;
        const MatrixXd solved = row.ties == Ties::lumped ?
                                  MatrixXd(system.rowwise().sum().cwiseInverse().asDiagonal() * rows) :
                                  MatrixXd(system.ldlt().solve(rows));
        of_particles          = light * solved;
        of_nodes              = coarse * solved;
      }

      void apply(Line &particles, Line &nodes) const
      {
        const VectorXd unlike = particles.velocity.tail(shape.rows()) - shape * nodes.velocity.head(shape.cols());
        particles.velocity.tail(shape.rows()) -= of_particles * unlike;
        nodes.velocity.head(shape.cols()) += of_nodes * unlike;
      }
    };

    /** The solid's weight at a place, 0 before the overlap and 1 behind it. */
    double weight(const Row &row, const double place)
    {
      constexpr double least = 1e-3;
      const double     part  = place / (row.overlap * row.element);
      return place <= 0 ? 0 : part >= 1 ? 1 : std::clamp(part, least, 1 - least);
    }

    void share(const Row &row, Line &particles)
    {
      const Index n = particles.place.size();
      for (Index i = 0; i + 1 < n; ++i)
        particles.spring[i] = 1 - weight(row, particles.place[i] + 0.5);
      for (Index i = 1; i < n; ++i)
        particles.mass[i] = 0.5 * (particles.spring[i - 1] + (i + 1 < n ? particles.spring[i] : 0.0));
      if (row.point_masses)
        for (Index i = 0; i < n; ++i)
          particles.mass[i] = 1 - std::min(weight(row, particles.place[i]), 1 - 1e-3);
      if (row.absorber.last_mass > 0)
        particles.mass[n - 1] = row.absorber.last_mass;
    }

    void share(const Row &row, Line &nodes, const double h)
    {
      nodes.mass.setZero();
      for (Index e = 0; e + 1 < nodes.place.size(); ++e)
        {
          nodes.spring[e] = weight(row, nodes.place[e] + 0.5 * h) / h;
          nodes.mass[e] += 0.5 * h * weight(row, nodes.place[e] + 0.25 * h);
          nodes.mass[e + 1] += 0.5 * h * weight(row, nodes.place[e] + 0.75 * h);
        }
    }

    double cubic_spline(const double t)
    {
      const double from = std::fabs(t);
      return from < 1 ? 2.0 / 3 - from * from + 0.5 * from * from * from : from < 2 ? std::pow(2 - from, 3) / 6 : 0.0;
    }

    /** Of cubic splines (columns) at places, knots from one on that lies at or before the first place less two spacings. */
    MatrixXd splines(const VectorXd &places, const double spacing, const double first)
    {
      const auto knots = static_cast<Index>((places[places.size() - 1] - first) / spacing) + 4;
      MatrixXd   spline(places.size(), knots);
      for (Index i = 0; i < places.size(); ++i)
        for (Index g = 0; g < knots; ++g)
          spline(i, g) = cubic_spline((places[i] - first) / spacing - static_cast<double>(g));
      return spline;
    }

    /** (Gv)_i = sum_g B_gi v_g, v_g = sum_i B_gi v_i / sum_i B_gi: whole masses, which are all 1. */
    MatrixXd average(const VectorXd &places, const double spacing, const double offset)
    {
      const MatrixXd spline = splines(places, spacing, spacing * (std::floor(places[0] / spacing) - 2 - offset));
      VectorXd       sums   = spline.colwise().sum().transpose();
      for (double &sum : sums)
        sum = sum > 0 ? 1 / sum : 0.0;
      return spline * sums.asDiagonal() * spline.transpose();
    }

    /** The fit least in energy, B (B^T M B)^-1 B^T M. Which way its grid lies is a choice: a knot a particle before the first. */
    MatrixXd projection(const VectorXd &places, const VectorXd &mass, const double spacing)
    {
      const MatrixXd spline = splines(places, spacing, places[0] - 1 - 2 * spacing),
                     scaled = spline.transpose() * mass.asDiagonal();
      return spline * MatrixXd(scaled * spline).completeOrthogonalDecomposition().solve(scaled);
    }

    /** Normal distributions of the given width around each particle, over the particles that there are. */
    MatrixXd gaussian_average(const VectorXd &places, const double width)
    {
      const Index n = places.size();
      MatrixXd    part(n, n);
      for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j)
          part(i, j) = std::exp(-0.5 * std::pow((places[i] - places[j]) / width, 2));
      return part.rowwise().sum().cwiseInverse().asDiagonal() * part;
    }

    /** What velocities of the tied particles become in an explicit step of damping: 1 - dt C (1 - P), P the fit by elements, least in energy. */
    MatrixXd less_residual(const Row &row, const Line &particles)
    {
      const MatrixXd shape  = shape_of(row);
      const Index    tied   = shape.rows();
      const VectorXd mass   = particles.mass.tail(tied);
      const MatrixXd scaled = shape.transpose() * mass.asDiagonal();
      const MatrixXd fit    = shape * MatrixXd(scaled * shape).ldlt().solve(scaled);
      const VectorXd rate   = VectorXd::LinSpaced(tied, 0, row.residual_rate);
      return MatrixXd::Identity(tied, tied) - row.step * rate.asDiagonal() * (MatrixXd::Identity(tied, tied) - fit);
    }

    /** G of the absorber among some particles. */
    MatrixXd smoothed(const Absorber &own, const VectorXd &places, const VectorXd &mass)
    {
      switch (own.smooth)
        {
        case Smooth::normal:
          return gaussian_average(places, own.spacing);
        case Smooth::projection:
          return projection(places, mass, own.spacing);
        default:
          return average(places, own.spacing, own.offset);
        }
    }

    /** What velocities of the last particles become in a step: exp(-m^-1 F^T C m F step), by modes. */
    MatrixXd damped(const Row &row, const Line &particles)
    {
      constexpr Index reach  = 120; // of averages; a fit is to the layer alone
      const Absorber &own    = row.absorber;
      const double    width  = row.overlap * row.element;
      const Index     beyond = own.smooth == Smooth::projection ? 1 : reach;
      const auto      n      = std::min(particles.place.size(), static_cast<Index>(own.layer + width) + beyond);
      const VectorXd  places = particles.place.tail(n), root = particles.mass.tail(n).cwiseSqrt();
      const MatrixXd  rest = MatrixXd::Identity(n, n) - smoothed(own, places, particles.mass.tail(n));
      MatrixXd        fine = MatrixXd::Identity(n, n);
      for (int p = 0; p < own.sharpness; ++p)
        fine = (rest * fine).eval();
      const VectorXd along = ((places.array() + own.layer) / (own.layer + width)).max(0).min(1);
      const MatrixXd scaled =
        VectorXd(std::sqrt(own.rate) * along.cwiseProduct(root)).asDiagonal() * fine * root.cwiseInverse().asDiagonal();
      const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(scaled.transpose() * scaled);
      const VectorXd                                left = (-row.step * modes.eigenvalues().cwiseMax(0)).array().exp();
      return root.cwiseInverse().asDiagonal() * modes.eigenvectors() * left.asDiagonal() *
             modes.eigenvectors().transpose() * root.asDiagonal();
    }
  } // namespace

  Answer transmit(const Row &row)
  {
    const Packet packet(row.wavelength);
    const double time = (row.followed * packet.width - packet.centre) / packet.speed, h = row.element;
    const auto   behind    = static_cast<Index>((row.followed + 2.4) * packet.width + 50),
               beyond      = static_cast<Index>(time + 5 * packet.width);
    const Index    in_both = row.overlap * row.element;
    const VectorXd whole =
      VectorXd::LinSpaced(behind + beyond + 1, -static_cast<double>(behind), static_cast<double>(beyond));
    Line alone(whole), particles(whole.head(behind + in_both + 1)),
      nodes(VectorXd::LinSpaced(beyond / row.element + 1, 0, h * static_cast<double>(beyond / row.element)));
    packet.start(alone, row.step);
    packet.start(particles, row.step);
    share(row, particles);
    share(row, nodes, h);
    const double   all = alone.energy(alone.place.size());
    const Tie      tie(row, particles, nodes);
    const MatrixXd absorber = row.absorber.sharpness > 0 ? damped(row, particles) : MatrixXd(),
                   residual = row.residual_rate > 0 ? less_residual(row, particles) : MatrixXd();
    for (auto steps = std::llround(time / row.step); steps > 0; --steps)
      {
        for (Line *line : {&alone, &particles, &nodes})
          line->kick(0.5 * row.step);
        if (absorber.size() > 0)
          particles.velocity.tail(absorber.rows()) = (absorber * particles.velocity.tail(absorber.rows())).eval();
        for (Line *line : {&alone, &particles, &nodes})
          line->kick(0.5 * row.step);
        if (residual.size() > 0)
          particles.velocity.tail(residual.rows()) = (residual * particles.velocity.tail(residual.rows())).eval();
        tie.apply(particles, nodes);
        for (Line *line : {&alone, &particles, &nodes})
          line->displacement += row.step * line->velocity;
      }
    return {particles.energy(behind - 2, &alone) / all, nodes.energy(nodes.place.size()) / all};
  }
} // namespace row_and_elements
