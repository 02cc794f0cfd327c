#pragma once

namespace fem
{
  /// Exponential damage with element-size regularisation: 1 - omega = exp(-(h/w_f)(kappa_D + omega f_t/E)).
  class DamageLaw
  {
  public:
    /// @param onset_strain f_t/E [-]; @param opening w_f [m].
    DamageLaw(double onset_strain, double opening);

    /// Largest element size that the law can regularise, E w_f / f_t [m].
    double largest_size() const noexcept;

    /// Integrity 1 - omega that solves the law with an offset in its exponent; d integrity / d kappa_D beside it.
    struct Integrity
    {
      double value, slope;
    };

    /// @param size h [m], below largest_size(). @param offset added to h (kappa_D + omega f_t/E) [m].
    Integrity integrity(double kappa_d, double size, double offset = 0.0) const noexcept;

    /// kappa_D that gives this damage at this size [-]. @pre 0 <= damage < 1.
    double inverse(double damage, double size) const noexcept;

  private:
    double onset_strain, opening;
  };
}
