#include "coupling/transmission/wave_medium.h"

#include "dem/core/uniform_random.h"

#include <cmath>
#include <complex>

namespace coupling
{
  using Lattice = WaveMedium::Lattice;

  double WaveMedium::height() const
  {
    return lattice == Lattice::chain ? spacing : hexagonal_row_pitch * spacing * static_cast<double>(rows);
  }

  double WaveMedium::stiffness_at(const Eigen::Vector3d &place) const
  {
    if (scatter == 0)
      return 1;
    // Links act a quarter of a spacing apart, in whole numbers, along a row, and half a row's height across.
    const auto along  = static_cast<std::uint64_t>(std::llround(4 * place.x() / spacing)),
               across = static_cast<std::uint64_t>(std::llround(2 * place.y() / (hexagonal_row_pitch * spacing)));
    dem::UniformRandom random(dem::mixed(dem::mixed(dem::mixed(static_cast<std::uint64_t>(seed)) + along) + across));
    return 1 + scatter * (2 * random() - 1);
  }

  double WaveMedium::effective_modulus() const
  {
    if (scatter == 0)
      return modulus;
    // Of the stiffness between a link's ends, the link itself is a part: all in a row, 4 motions over 6 links in rows of them. The average of
    // (k - k') / (k' (1 / part - 1) + k), evenly over k, vanishes at k'.
    const double part = lattice == Lattice::chain ? 1.0 : 2.0 / 3.0, around = 1 / part - 1;
    double       now = 1, last = 0;
    while (std::fabs(now - last) > 1e-14)
      {
        last = now;
        now  = part * scatter / std::atanh(scatter / (around * last + 1));
      }
    return now * modulus;
  }

  double WaveMedium::young() const
  {
    // Of hexagonal rows lambda = mu = sqrt(3)/4 k.
    return lattice == Lattice::chain ? effective_modulus() : 2.5 * std::sqrt(3) / 4 * effective_modulus();
  }

  double WaveMedium::poisson() const { return lattice == Lattice::chain ? 0.0 : 0.25; }

  double WaveMedium::wave_speed(const bool shear) const
  {
    if (lattice == Lattice::chain)
      return std::sqrt(effective_modulus() / density);
    return std::sqrt((shear ? 1 : 3) * std::sqrt(3) / 4 * effective_modulus() / density);
  }

  double WaveMedium::frequency(const bool shear, const double k) const
  {
    const double a = spacing, half = 0.5 * k * a;
    if (lattice == Lattice::chain)
      return 2 * std::sqrt(effective_modulus() / density) / a * std::sin(half);
    // Plane waves along the rows of a hexagonal lattice of central springs k = E, masses m = rho a^2 sqrt(3)/2.
    const double mass = density * hexagonal_row_pitch * a * a, inclined = 4 * std::pow(std::sin(0.5 * half), 2);
    const double along = shear ? 0.0 : 4 * std::pow(std::sin(half), 2);
    return std::sqrt(effective_modulus() / mass * (along + (shear ? 0.75 : 0.25) * 2 * inclined));
  }

  double WaveMedium::share_across(const double y) const
  {
    constexpr double rounding = 1e-9;
    const bool on_line = lattice == Lattice::strip && (y < rounding * spacing || y > height() - rounding * spacing);
    return on_line ? 0.5 : 1.0;
  }

  double WaveMedium::group_speed(const bool shear, const double k) const
  {
    const double small = 1e-5 * k;
    return (frequency(shear, k + small) - frequency(shear, k - small)) / (2 * small);
  }

  double edge_to_edge_reflection(const std::int64_t element, const double wavelength)
  {
    using Complex  = std::complex<double>;
    const auto   n = static_cast<double>(element);
    const double q = 2 * M_PI / wavelength, omega = 2 * std::sin(0.5 * q), sine = 0.5 * n * omega;
    // In the mesh e^(ip) with omega = (2/n) sin(p/2); beyond its cut-off the decaying one.
    const Complex next =
      sine <= 1 ? std::exp(Complex(0, 2 * std::asin(sine))) : Complex(-std::exp(-2 * std::acosh(sine)));
    const Complex node = 0.5 * (n + 1) * omega * omega + (next - 1.0) / n;
    const Complex wave = std::exp(Complex(0, q));
    return std::norm((node - (1.0 - std::conj(wave))) / (-node + (1.0 - wave)));
  }
} // namespace coupling
