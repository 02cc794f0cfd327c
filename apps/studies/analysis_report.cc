#include "apps/studies/analysis_files.h"
#include "postprocess/files/html_page.h"

namespace apps
{
  std::string report_of(const Analysis &analysis, const std::filesystem::path &folder)
  {
    postprocess::HtmlPage page("Analysis of " + analysis.table.response + " in " + analysis.table.file.string());
    page.lines(words_of(analysis));
    page.picture(folder / "effects.png", "Means at the levels of each factor");
    page.picture(folder / "half_normal.png", "Sizes of effects");
    page.picture(folder / "residuals.png", "Predicted and found, and studentised residuals");
    page.picture(folder / "contours.png", "The surface over its leading factors");
    return page.text();
  }
} // namespace apps
