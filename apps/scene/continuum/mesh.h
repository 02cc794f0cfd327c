#pragma once

#include "apps/runs/continuum/mesh.h"

namespace apps
{
  class Section;

  void declare(Section &section, BoxSection &box, const int &dimension);
  void declare(Section &section, BallSection &ball);
  void declare(Section &root, MeshSection &mesh, const int &dimension);
} // namespace apps
