#pragma once
/// BibTeX entries of the software and of one result.

#include <cstdint>
#include <string>

#include <thinwall/experiments/results/record.hpp>

namespace thinwall {

/// What CITATION.cff says of the software.
struct SoftwareCitation {
  std::string title;
  std::string authors;        ///< a BibTeX list
  std::string version, date;  ///< of that release; ISO 8601
  std::string license;        ///< an SPDX name
};

struct ResultCitation {
  std::string experiment, question;
  std::string run_id;  ///< of experiment, config, seed and trials together
  std::uint64_t seed = 0;
  std::string commit;  ///< full git hash of the program, or "unknown"
  bool dirty = false;  ///< tracked files differed from that commit
  std::string date;    ///< ISO 8601, of the day it was finished
};

/// This program, as CITATION.cff named it when it was built.
SoftwareCitation this_software();

ResultCitation citation_of(const RunRecord& run);

std::string bibtex(const SoftwareCitation& software);
std::string bibtex(const ResultCitation& result);

/// The whole of cite.bib: the software, then the result.
std::string bibtex(const SoftwareCitation& software, const ResultCitation& result);

}  // namespace thinwall
