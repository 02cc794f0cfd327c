#include "dem/facets/surface_law.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <algorithm>

namespace dem
{
  namespace
  {
    constexpr std::size_t shear_components = 3;

    /** A row of a history: the memory, then the shear. */
    using Row = std::array<double, std::tuple_size_v<FaceMemory> + shear_components>;

    Row row_of(const FaceMemory &memory, const std::size_t numbers, const Eigen::Vector3d &shear)
    {
      Row row{};
      std::copy_n(memory.begin(), numbers, row.begin());
      std::copy_n(shear.data(), shear_components, row.begin() + static_cast<std::ptrdiff_t>(numbers));
      return row;
    }
  } // namespace

  SurfaceLaw::SurfaceLaw(const LinkMaterials &materials, const Physics &physics, const std::string &name)
    : law(materials.contacts_in_space(physics))
  {
    const std::size_t columns = law->columns().size();
    if (!law->waits() || law->has_moment() || columns < shear_components || columns > std::tuple_size_v<Row>)
      throw base::InputError("wall " + name + ": the law " + law->name() +
                             " has no contacts with surfaces. Take linear or hertz-mindlin.");
    numbers = columns - shear_components;
    if (const auto *of_springs = dynamic_cast<const LinkLawOf<LinearContact> *>(law.get()))
      straight = of_springs->constants(0);
  }

  FaceMemory SurfaceLaw::begin(const double radius, const double area, const double mass) const
  {
    FaceMemory memory{};
    if (numbers == 0)
      return memory;
    NewLink fresh;
    fresh.distance = fresh.first_radius = radius;
    fresh.area                          = area;
    fresh.effective_mass                = mass;
    fresh.on_face                       = true;
    Row row{};
    law->begin(0, fresh, row.data());
    std::copy_n(row.begin(), numbers, memory.begin());
    return memory;
  }

  LinkGeometry SurfaceLaw::geometry(const FaceContact &contact, const double overlap) const
  {
    return {-overlap / contact.radius, contact.radius - overlap, contact.radius, contact.area};
  }

  FacePressure SurfaceLaw::press(const FaceContact &contact, const FaceMemory &memory) const
  {
    const Row          row = row_of(memory, numbers, Eigen::Vector3d::Zero());
    const LinkGeometry now = geometry(contact, contact.overlap);
    LinkStep           resting;
    resting.geometry      = now;
    resting.strain_before = now.strain;
    Row  ignored          = row;
    auto answer           = law->update(0, resting, row.data(), ignored.data());
    return {-contact.share * answer.force.dot(resting.direction),
            contact.share * law->damaged_stiffness(0, now, row.data()).normal * contact.area / contact.radius,
            contact.share * law->stored(0, now, row.data())};
  }

  double SurfaceLaw::shear_stiffness(const FaceContact &contact, const FaceMemory &memory) const
  {
    const Row row = row_of(memory, numbers, Eigen::Vector3d::Zero());
    return contact.share * law->stiffness(0, geometry(contact, contact.overlap), row.data()).shear * contact.area /
           contact.radius;
  }

  double SurfaceLaw::stiffness_of_step(const FaceContact &contact, const double lever, const FaceMemory &memory) const
  {
    const Row             row = row_of(memory, numbers, Eigen::Vector3d::Zero());
    const LinkStiffnesses s   = law->stiffness_of_step(0, geometry(contact, contact.overlap), row.data());
    return contact.area / contact.radius * std::max(s.normal, s.shear * (1 + lever));
  }

  double
  SurfaceLaw::stored_in_shear(const FaceContact &contact, const Eigen::Vector3d &shear, const FaceMemory &memory) const
  {
    const LinkGeometry now  = geometry(contact, contact.overlap);
    const Row          bare = row_of(memory, numbers, Eigen::Vector3d::Zero()), row = row_of(memory, numbers, shear);
    return contact.share * (law->stored(0, now, row.data()) - law->stored(0, now, bare.data()));
  }

  FaceAnswer SurfaceLaw::follow(const FaceContact     &contact,
                                const double           at_rest,
                                const Eigen::Vector3d &direction,
                                const Eigen::Vector3d &added,
                                const double           per_second,
                                Eigen::Vector3d       &shear,
                                FaceMemory            &memory) const
  {
    LinkStep step;
    step.geometry        = geometry(contact, contact.overlap);
    step.strain_before   = -contact.before / contact.radius;
    step.direction       = direction;
    step.shear_increment = added;
    step.per_second      = per_second;
    step.carried         = true;
    const Row  before    = row_of(memory, numbers, shear);
    Row        after     = before;
    const auto answer    = law->update(0, step, before.data(), after.data());
    std::copy_n(after.begin(), numbers, memory.begin());
    shear                         = Eigen::Vector3d(&after[numbers]);
    const Eigen::Vector3d besides = contact.share * answer.force + at_rest * direction;
    return {besides, viscous() ? -besides.dot(direction) : 0.0, contact.share * answer.friction,
            contact.share * answer.viscous};
  }
} // namespace dem
