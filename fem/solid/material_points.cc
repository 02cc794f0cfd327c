#include "fem/solid/material_points.h"

#include "fem/materials/anisotropic_elastic.h"
#include "fem/materials/isotropic_elastic.h"
#include "fem/materials/mixed_control.h"
#include "fem/solid/nonlocal_points.h"

#include <type_traits>

namespace fem
{
  namespace
  {
    /// Out-of-plane strains zz, yz, zx of a plane-stress point.
    using OutOfPlane = Eigen::Vector3d;

    /// Stiffness of a plane-stress point: the out-of-plane rows condensed, zero outside xx, yy, xy.
    Stiffness condensed(const Stiffness &full)
    {
      static constexpr int in[3] = {0, 1, 5}, out[3] = {2, 3, 4};
      Eigen::Matrix3d      aa, ab, ba, bb;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            aa(i, j) = full(in[i], in[j]);
            ab(i, j) = full(in[i], out[j]);
            ba(i, j) = full(out[i], in[j]);
            bb(i, j) = full(out[i], out[j]);
          }
      const Eigen::Matrix3d plane  = aa - ab * bb.partialPivLu().solve(ba);
      Stiffness             result = Stiffness::Zero();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          result(in[i], in[j]) = plane(i, j);
      return result;
    }

    template <typename Law>
    class PointsOf : public MaterialPoints
    {
    public:
      PointsOf(const Law &law_, const Plane plane)
        : law(law_)
        , plane_stress(plane == Plane::stress)
      {
      }

      const char *material_name() const override { return Law::name; }

      void allocate(const std::size_t n_points) override
      {
        committed.assign(n_points, {});
        trial.assign(n_points, {});
        if (plane_stress)
          out.assign(n_points, OutOfPlane::Zero());
        if (plane_stress)
          out_trial.assign(n_points, OutOfPlane::Zero());
      }

      void evaluate(const std::size_t    point,
                    const Voigt         &strain,
                    const ElementExtent &element,
                    const bool           with_tangent,
                    PointAnswer         &answer) override
      {
        if (plane_stress)
          return evaluate_plane_stress(point, strain, element, answer);
        const auto r  = law.evaluate(strain, committed[point], element, with_tangent);
        trial[point]  = r.trial;
        answer.stress = r.stress;
        if (with_tangent)
          answer.tangent = r.tangent;
      }

      void commit() override
      {
        committed = trial;
        out       = out_trial;
      }

      void set_initial([[maybe_unused]] const std::size_t        point,
                       [[maybe_unused]] const InitialPointState &given,
                       [[maybe_unused]] const ElementExtent     &element) override
      {
        if constexpr (std::is_same_v<Law, DamagePlasticConcrete>)
          trial[point] = committed[point] = law.initial_state(given, element);
        else
          throw std::invalid_argument(std::string(Law::name) +
                                      ": has no history, so no initial state can be given to it.");
      }

      void visit(const std::size_t point, const StateColumn &column) override
      {
        Law::describe_state(committed[point], column);
        if (plane_stress)
          column("out-of-plane strain", out[point].data(), 3);
        trial[point] = committed[point];
        if (plane_stress)
          out_trial[point] = out[point];
      }

      const Stiffness &elastic_stiffness() const override { return law.elastic_stiffness(); }

      bool linear() const override { return std::is_empty_v<typename Law::State>; }

    private:
      void evaluate_plane_stress(const std::size_t    point,
                                 const Voigt         &strain,
                                 const ElementExtent &element,
                                 PointAnswer         &answer)
      {
        MixedTarget target;
        target.stress_given = {false, false, true, true, true, false};
        target.value << strain[0], strain[1], 0, 0, 0, strain[5];
        Voigt guess         = strain;
        guess.segment<3>(2) = out[point];
        const double unit   = law.elastic_stiffness()(0, 0) * std::fmax(strain.cwiseAbs().maxCoeff(), 1e-12);
        const auto   s      = solve_mixed(law, guess, target, committed[point], element, unit);
        trial[point]        = s.response.trial;
        out_trial[point]    = s.strain.template segment<3>(2);
        answer.stress       = s.response.stress;
        answer.stress[2] = answer.stress[3] = answer.stress[4] = 0;
        answer.tangent                                         = condensed(s.response.tangent);
      }

      Law                              law;
      bool                             plane_stress;
      std::vector<typename Law::State> committed, trial;
      std::vector<OutOfPlane>          out, out_trial;
    };
  }

  std::unique_ptr<MaterialPoints> make_points(const IsotropicElastic &law, const Plane plane)
  {
    return std::make_unique<PointsOf<IsotropicElastic>>(law, plane);
  }

  std::unique_ptr<MaterialPoints> make_points(const AnisotropicElastic &law, const Plane plane)
  {
    return std::make_unique<PointsOf<AnisotropicElastic>>(law, plane);
  }

  std::unique_ptr<MaterialPoints> make_points(const DamagePlasticConcrete &law, const Plane plane)
  {
    if (law.parameters().nonlocal_length > 0 && plane == Plane::stress)
      throw std::invalid_argument("Nonlocal length: is not built for plane stress.");
    if (law.parameters().nonlocal_length > 0)
      return std::make_unique<NonlocalPoints>(law);
    return std::make_unique<PointsOf<DamagePlasticConcrete>>(law, plane);
  }
}
