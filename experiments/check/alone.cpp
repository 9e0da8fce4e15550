#include <set>

#include <fmt/format.h>

#include <thinwall/experiments/check/html_tags.hpp>
#include <thinwall/experiments/check/parts.hpp>
#include <thinwall/experiments/text/escape.hpp>

namespace thinwall {
namespace {

/// What a report is made of, and the pictures in it; none of it runs, or loads anything but by `href`.
bool is_plain(const std::string& element) {
  static const std::set<std::string> html = {
      "html",  "head",  "meta", "title", "style",  "link",   "body",       "main",    "section",
      "h1",    "h2",    "h3",   "p",     "figure", "strong", "div",        "caption", "figcaption",
      "table", "thead", "tr",   "tbody", "th",     "td",     "a",          "ul",      "li",
      "dl",    "dt",    "dd",   "pre",   "em",     "code",   "span",       "sup",     "sub",
      "b",     "i",     "br",   "hr",    "ol",     "h4",     "blockquote", "details", "summary"};
  static const std::set<std::string> svg = {
      "svg",    "g",    "defs",    "desc",        "use",     "text",        "tspan",          "path",          "rect",
      "circle", "line", "ellipse", "polyline",    "polygon", "clippath",    "mask",           "pattern",       "symbol",
      "filter", "stop", "feflood", "fecomposite", "femerge", "femergenode", "lineargradient", "radialgradient"};
  return html.contains(element) || svg.contains(element);
}

struct AloneCheck {
  const KeptResult& result;
  Faults& faults;
  std::set<std::string> said = {};  // once each

  void add(const std::string& what) {
    if (said.insert(what).second) faults.push_back(fmt::format("{}: {}", page_file, one_line(what)));
  }

  /// A link within the page or the folder; for the page's icon, which is empty, also `data:`.
  void check_link(const HtmlTag& tag, const std::string& value) {
    if (value.empty() || value.starts_with('#') || (tag.name == "link" && value == "data:,")) return;
    const std::string target = html_unescaped(value);
    if (tag.name != "a" || target.find(':') != std::string::npos || target.starts_with('/') ||
        target.find("..") != std::string::npos) {
      add(fmt::format("asks for '{}'", clipped(target, 60)));
    } else if (!std::filesystem::exists(result.folder / target)) {
      add(fmt::format("links to '{}', which is not there", clipped(target, 60)));
    }
  }

  void check_tag(const HtmlTag& tag) {
    static const std::set<std::string> loading = {"src",        "srcset", "poster", "action", "formaction",
                                                  "background", "ping",   "data",   "srcdoc"};
    if (!is_plain(tag.name)) add(fmt::format("'<{}' in a page that stands alone", clipped(tag.name, 40)));
    for (const auto& [name, value] : tag.attributes) {
      if (name == "href" || name.ends_with(":href")) check_link(tag, value);
      if (loading.contains(name)) add(fmt::format("asks for '{}'", clipped(value, 60)));
      if (name.starts_with("on") || name == "http-equiv")
        add(fmt::format("attribute '{}' in a page that stands alone", clipped(name, 40)));
    }
  }

  /// Style sheets load by these, and old ones run.
  void check_styles(const std::string& lower) {
    for (const char* never : {"<script", "@import", "image-set(", "javascript:", "expression("}) {
      if (lower.find(never) != std::string::npos) add(fmt::format("'{}' in a page that stands alone", never));
    }
    for (auto at = lower.find("url("); at != std::string::npos; at = lower.find("url(", at + 1)) {
      const std::string target = lower.substr(at + 4, 6);
      if (target.find('#') > 1) add(fmt::format("'url({}...' in a page that stands alone", target));
    }
  }
};

}  // namespace

void check_stands_alone(const KeptResult& result, const std::string& page, Faults& faults) {
  AloneCheck check{result, faults};
  for (const HtmlTag& tag : tags_of(page)) check.check_tag(tag);
  check.check_styles(lower_case(page));
}

}  // namespace thinwall
