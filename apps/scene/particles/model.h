#pragma once

#include "apps/runs/particles/model.h"

namespace apps
{
  class Section;

  void declare(Section &root, ParticlesModel &model);
  /** What is there: all sections but Laboratory and the four of the course. */
  void declare_as_part(Section &root, ParticlesModel &model);
  /** How it goes on: sections Time, Gravity, Stop and Output. @param weight meaning of section Gravity */
  void declare_course(Section &root, ParticlesModel &model, const char *weight = "Weight of the particles");
} // namespace apps
