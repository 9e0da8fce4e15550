#pragma once
/// The report: one page of HTML that stands alone, without a script or a request to anywhere; its prose is that of docs/.

#include <map>
#include <string>
#include <vector>

#include <thinwall/experiments/experiment.hpp>
#include <thinwall/experiments/lab/manifest.hpp>

namespace thinwall {

struct ReportParts {
  std::map<std::string, std::string> svgs;  ///< by the figure's name; one that could not be drawn is missing
  std::string why_no_svg;                   ///< empty if every figure was drawn
  std::vector<std::string> files;           ///< paths of the other files of the result, to link to
  std::string citation;                     ///< BibTeX
};

std::string report_page(const RunRecord& run, const Outcome& outcome, const ReportParts& parts);

}  // namespace thinwall
