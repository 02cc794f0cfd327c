#pragma once

#include "fem/materials/damage_plastic/yield_surface.h"

#include <optional>

namespace fem
{
  /// Trial state of one implicit step: x = sigma_V / f_c, y = rho / f_c, Lode angle, hardening variable.
  struct PlasticTrial
  {
    double x, y, theta, kappa;
  };

  enum class ReturnKind
  {
    elastic,
    regular,
    vertex
  };

  /// End of the step, and its derivative with respect to the trial (rows x, y, kappa; columns x, y, theta, kappa).
  struct PlasticReturn
  {
    double                      x, y, kappa;
    ReturnKind                  kind;
    Eigen::Matrix<double, 3, 4> sensitivity;
  };

  /**
   * Backward Euler return of Grassl and Jirasek (2006); doc/theory/damage-plastic-concrete.md, 4.
   *
   * Departure: the model hardens a vertex return with (2 cos 0)^2 and a regular one with (2 cos theta)^2. Off
   * the axis this leaves trial stresses that neither return takes, and a jump of stress between the two. Here the factor
   * of the vertex goes from (2 cos 0)^2 on the axis to (2 cos theta)^2 within a narrow cone around it, so that the
   * two returns meet where rho vanishes.
   */
  class ReturnMapping
  {
  public:
    static constexpr double tolerance = 1e-11; ///< on every residual, each of order one

    explicit ReturnMapping(const DamagePlasticParameters &parameters);

    /// @return nothing if no admissible state was found: the caller divides the step.
    std::optional<PlasticReturn> operator()(const PlasticTrial &trial) const;

    const YieldSurface &surface() const noexcept { return yield_surface; }

  private:
    struct Unknowns
    {
      double x, y, kappa, multiplier; // multiplier = dlambda 2G / f_c^2
    };
    struct System
    {
      Eigen::Vector4d residual;
      Eigen::Matrix4d jacobian;
    };

    System                       equations(const Unknowns &z, const PlasticTrial &trial) const;
    std::optional<Unknowns>      newton(Unknowns z, const PlasticTrial &trial, bool hardening_frozen) const;
    std::optional<Unknowns>      at_strength(const PlasticTrial &trial) const;
    std::optional<Unknowns>      nested(const PlasticTrial &trial) const;
    std::optional<Unknowns>      from_other_starts(const PlasticTrial &trial) const;
    std::optional<PlasticReturn> regular(const PlasticTrial &trial) const;

    /// Hardening variable after a return to a point of the axis, and its derivatives.
    struct VertexKappa
    {
      double value, x, trial_x, trial_y, theta;
    };
    VertexKappa                  vertex_kappa(double x, const PlasticTrial &trial, double cone) const;
    std::optional<double>        vertex_bracket_end(const PlasticTrial &trial) const;
    std::optional<PlasticReturn> vertex(const PlasticTrial &trial, double cone) const;
    PlasticReturn                vertex_result(double x, const PlasticTrial &trial, double cone) const;

    YieldSurface yield_surface;
    double       bulk_over_shear; // K / 2G
    double       strain_unit;     // f_c / 2G
    double       vertex_norm;     // factor of (3.2)
    double       tensile_ratio;   // f_t / f_c
  };
}
