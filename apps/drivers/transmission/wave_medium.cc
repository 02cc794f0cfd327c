#include "apps/drivers/transmission/wave_medium.h"

#include <cmath>
#include <complex>

namespace apps
{
  using Lattice = WaveMedium::Lattice;

  double WaveMedium::height() const
  {
    return lattice == Lattice::chain ? spacing : hexagonal_row_pitch * spacing * static_cast<double>(rows);
  }

  double WaveMedium::young() const
  {
    return lattice == Lattice::chain ? modulus : 2.5 * std::sqrt(3) / 4 * modulus; // lambda = mu = sqrt(3)/4 k
  }

  double WaveMedium::poisson() const { return lattice == Lattice::chain ? 0.0 : 0.25; }

  double WaveMedium::wave_speed(const bool shear) const
  {
    if (lattice == Lattice::chain)
      return std::sqrt(modulus / density);
    return std::sqrt((shear ? 1 : 3) * std::sqrt(3) / 4 * modulus / density);
  }

  double WaveMedium::frequency(const bool shear, const double k) const
  {
    const double a = spacing, half = 0.5 * k * a;
    if (lattice == Lattice::chain)
      return 2 * std::sqrt(modulus / density) / a * std::sin(half);
    // Plane waves along the rows of a hexagonal lattice of central springs k = E, masses m = rho a^2 sqrt(3)/2.
    const double mass = density * hexagonal_row_pitch * a * a, inclined = 4 * std::pow(std::sin(0.5 * half), 2);
    const double along = shear ? 0.0 : 4 * std::pow(std::sin(half), 2);
    return std::sqrt(modulus / mass * (along + (shear ? 0.75 : 0.25) * 2 * inclined));
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
} // namespace apps
