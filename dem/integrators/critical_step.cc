#include "dem/integrators/stable_step.h"

#include "dem/core/symmetric_modes.h"
#include "dem/measures/link_measures.h"

#include <Eigen/Geometry>

#include <Spectra/SymEigsSolver.h>

#include <cmath>
#include <stdexcept>

namespace dem
{
  namespace
  {
    /** M^-1/2 K M^-1/2 of the undamaged links, applied link by link; six unknowns per particle (translation, rotation). */
    class ScaledStiffness
    {
    public:
      using Scalar = double;

      ScaledStiffness(const Particles &particles, const std::vector<LawfulLinks> &all, const bool rotations)
        : p(particles)
        , root_inverse_mass(6 * particles.count)
      {
        for (std::size_t i = 0; i < p.count; ++i)
          for (int c = 0; c < 6; ++c)
            root_inverse_mass[6 * i + c] = c < 3 || rotations ? std::sqrt(p.inverse_mass[record_size * i + c]) : 0.0;
        for (const LawfulLinks &of : all)
          add(of.links, of.law);
      }

      Eigen::Index rows() const { return root_inverse_mass.size(); }
      Eigen::Index cols() const { return rows(); }

      void perform_op(const double *in, double *out) const
      {
        const Eigen::VectorXd u = root_inverse_mass.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(in, rows()));
        Eigen::VectorXd       f = Eigen::VectorXd::Zero(rows());
        for (const Spring &s : springs)
          {
            const auto at = [&](const std::int32_t i, const int part) { return u.segment<3>(6 * i + 3 * part); };
            const Eigen::Vector3d spin  = s.arm_J * at(s.J, 1) + s.arm_K * at(s.K, 1);
            const Eigen::Vector3d slip  = at(s.K, 0) - at(s.J, 0) + s.n.cross(spin);
            const double          along = s.n.dot(slip);
            const Eigen::Vector3d force = s.k_T * slip + (s.k_N - s.k_T) * along * s.n;
            const Eigen::Vector3d twist = -s.n.cross(force);
            f.segment<3>(6 * s.J) -= force;
            f.segment<3>(6 * s.K) += force;
            f.segment<3>(6 * s.J + 3) += s.arm_J * twist;
            f.segment<3>(6 * s.K + 3) += s.arm_K * twist;
            if (s.k_bending == 0 && s.k_twist == 0)
              continue;
            const Eigen::Vector3d turned = at(s.K, 1) - at(s.J, 1);
            const Eigen::Vector3d moment = s.k_bending * turned + (s.k_twist - s.k_bending) * s.n.dot(turned) * s.n;
            f.segment<3>(6 * s.J + 3) -= moment;
            f.segment<3>(6 * s.K + 3) += moment;
          }
        Eigen::Map<Eigen::VectorXd>(out, rows()) = root_inverse_mass.cwiseProduct(f);
      }

    private:
      struct Spring
      {
        std::int32_t    J, K;
        Eigen::Vector3d n;
        double          arm_J, arm_K, k_N, k_T, k_bending, k_twist;
      };

      void add(const LinkSet &links, const LinkLaw &law)
      {
        LinkReader reader(p, links, law);
        for (std::size_t l = 0; l < links.count; ++l)
          {
            if (!links.is_alive(l))
              continue;
            reader.read(l, Geometry::present);
            const LinkStiffnesses moduli = reader.stiffness();
            Spring                s;
            s.J                 = links.first[l];
            s.K                 = links.second[l];
            s.n                 = branch_of(p, links, l);
            const double length = s.n.norm(), eccentric = p.radius_of(s.J) - p.radius_of(s.K),
                         stiffness = links.area[l] / links.reference_length[l];
            s.n /= length;
            s.arm_J     = 0.5 * (length + eccentric);
            s.arm_K     = 0.5 * (length - eccentric);
            s.k_N       = moduli.normal * stiffness;
            s.k_T       = moduli.shear * stiffness;
            s.k_bending = moduli.bending;
            s.k_twist   = moduli.twist;
            springs.push_back(s);
          }
      }

      const Particles    &p;
      Eigen::VectorXd     root_inverse_mass;
      std::vector<Spring> springs;
    };

    /** Of few particles: their Krylov spaces end early, and what Lanczos goes on with there may be no eigenvalue at all. */
    constexpr Eigen::Index most_dense_rows = 240;

    double largest_of_dense(const ScaledStiffness &operation)
    {
      Eigen::MatrixXd       matrix(operation.rows(), operation.rows());
      const Eigen::MatrixXd units = Eigen::MatrixXd::Identity(operation.rows(), operation.rows());
      for (Eigen::Index c = 0; c < operation.rows(); ++c)
        operation.perform_op(units.col(c).data(), matrix.col(c).data());
      return symmetric_modes(matrix).values.maxCoeff();
    }

    double largest_by_lanczos(ScaledStiffness &operation)
    {
      // The spectrum of a random packing is dense at its upper end; 40 vectors between restarts converge in a few hundred products.
      constexpr int                           vectors   = 40;
      constexpr double                        tolerance = 1e-10;
      Spectra::SymEigsSolver<ScaledStiffness> solver(operation, 1, vectors);
      solver.init();
      solver.compute(Spectra::SortRule::LargestAlge, 10000, tolerance);
      if (solver.info() != Spectra::CompInfo::Successful)
        throw std::runtime_error(
          "critical step: the Lanczos iteration for the largest eigenvalue did not converge in 10000 restarts.");
      const double          largest = solver.eigenvalues()[0];
      const Eigen::VectorXd mode    = solver.eigenvectors(1);
      Eigen::VectorXd       image(mode.size());
      operation.perform_op(mode.data(), image.data());
      if (!((image - largest * mode).norm() <= std::sqrt(tolerance) * largest))
        throw std::runtime_error("critical step: the Lanczos iteration ended with a value that is no eigenvalue.");
      return largest;
    }
  } // namespace

  double critical_step(const Particles &particles, const std::vector<LawfulLinks> &links, const bool rotations)
  {
    ScaledStiffness operation(particles, links, rotations);
    const bool      few = operation.rows() <= most_dense_rows;
    return 2.0 / std::sqrt(few ? largest_of_dense(operation) : largest_by_lanczos(operation));
  }
} // namespace dem
