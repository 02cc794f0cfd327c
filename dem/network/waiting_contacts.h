#pragma once

#include "dem/model/link_law.h"
#include "dem/model/materials.h"
#include "dem/network/elastic_network.h"

#include <memory>

namespace dem
{
  /** The law of a network's links, for pairs numbered as theirs: bonds, and contacts that wait if there are any. @throws base::InputError */
  std::shared_ptr<const LinkLaw> law_of_links(const ElasticNetwork &network, const LinkMaterials &materials);

  /**
   * The law of a network's bonds, and for pairs from bonds.pairs() on that of contacts between particles that are still apart: they carry
   * nothing while they are, and obey the law of contacts from where they touch. Of a step in which they come to touch only what
   * is left of it after that shears them; once they part, what they remember is that of a new contact (doc/theory/periodic-cell.md, 6).
   *
   * @param contacts of as many pairs
   */
  std::shared_ptr<const LinkLaw> with_waiting_contacts(std::shared_ptr<const LinkLaw> bonds,
                                                       std::shared_ptr<const LinkLaw> contacts);
} // namespace dem
