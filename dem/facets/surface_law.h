#pragma once

#include "dem/laws/linear_contact.h"
#include "dem/model/materials.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

namespace dem
{
  /** One sphere on a face, as the law of its contact sees it. */
  struct FaceContact
  {
    double radius  = 0;             ///< of the sphere; the reference length [m]
    double area    = 0;             ///< of a whole contact [m^2]
    double share   = 1;             ///< of one
    double overlap = 0, before = 0; ///< now and a step ago; 0 or below: apart [m]
  };

  /** What presses on the sphere, at rest. */
  struct FacePressure
  {
    double force     = 0; ///< [N]
    double stiffness = 0; ///< its slope [N/m]
    double stored    = 0; ///< [J]
  };

  /** What a law remembers of one contact besides its elastic shear. */
  using FaceMemory = std::array<double, 3>;

  /** Of a step of a contact. */
  struct FaceAnswer
  {
    Eigen::Vector3d force    = {0, 0, 0};      ///< on the sphere, besides the pressure at rest [N]
    double          dashpot  = 0;              ///< part of it that the speed of approach makes, away from the face [N]
    double          friction = 0, viscous = 0; ///< dissipated [J]
  };

  /**
   * The law by which particles touch a surface: any law of contacts that is zero while nothing touches, with the surface for a face
   * without curvature (doc/theory/facets.md, 3). Linear contacts, which most surfaces have, are found without a detour.
   */
  class SurfaceLaw
  {
  public:
    /** @param name of the surface, for messages @throws base::InputError for a law that surfaces cannot have */
    SurfaceLaw(const LinkMaterials &materials, const Physics &physics, const std::string &name);

    /** Constants of linear contacts without a dashpot; nothing for another law. */
    const std::optional<LinearContactConstants> &linear() const { return straight; }
    bool                                         viscous() const { return law->viscous(); }
    bool                                         stiffens() const { return law->stiffens(); }

    /** A contact begins. @param mass of the particle by itself [kg] */
    FaceMemory   begin(double radius, double area, double mass) const;
    FacePressure press(const FaceContact &contact, const FaceMemory &memory) const;
    /** Slope of the shear force [N/m]. */
    double shear_stiffness(const FaceContact &contact, const FaceMemory &memory) const;
    /** The largest that an explicit step sees: across, and along times 1 + lever [N/m]. */
    double stiffness_of_step(const FaceContact &contact, double lever, const FaceMemory &memory) const;
    /** Stored in shear [J]. @param shear elastic displacement over the radius [-] */
    double stored_in_shear(const FaceContact &contact, const Eigen::Vector3d &shear, const FaceMemory &memory) const;
    /**
     * A step: the shear slides or not, the memory goes on.
     * @param at_rest pressure as press() has it [N] @param added displacement along the face in it over the radius @param shear in: with it
     * @param per_second as LinkStep has it
     */
    FaceAnswer follow(const FaceContact     &contact,
                      double                 at_rest,
                      const Eigen::Vector3d &direction,
                      const Eigen::Vector3d &added,
                      double                 per_second,
                      Eigen::Vector3d       &shear,
                      FaceMemory            &memory) const;

  private:
    LinkGeometry geometry(const FaceContact &contact, double overlap) const;

    std::shared_ptr<const LinkLaw>        law;
    std::optional<LinearContactConstants> straight;
    std::size_t                           numbers = 0; ///< of its memory
  };
} // namespace dem
