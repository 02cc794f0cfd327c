#pragma once

#include <string>

namespace fem
{
  class MaterialKind;
}

namespace apps
{
  class Section;

  /** Of the sections Specimen, Material or Materials, Regions and Physics in a section. @throws base::InputError for an unreadable packing */
  std::string digest_of_particles(const Section &particles);

  /** Of the section of the law of one group of elements, but for its numerical constants. */
  std::string digest_of_material(const Section &law, const fem::MaterialKind &kind);
} // namespace apps
