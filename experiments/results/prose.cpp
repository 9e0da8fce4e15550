#include <thinwall/experiments/results/prose.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <md4c-html.h>

#include <thinwall/experiments/text/escape.hpp>
#include <thinwall_embedded.hpp>

namespace thinwall {
namespace {

struct Chapter {
  std::string heading;
  std::string markdown;  ///< with its heading
};

/// What stands below each heading of the second level; what comes before the first has an empty one.
std::vector<Chapter> chapters_of(std::string_view page) {
  std::vector<Chapter> chapters(1);
  bool is_code = false;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t end = std::min(page.find('\n', at), page.size());
    const std::string_view line = page.substr(at, end - at);
    if (line.starts_with("```")) is_code = !is_code;
    if (!is_code && line.starts_with("## ")) chapters.push_back({std::string(line.substr(3)), ""});
    chapters.back().markdown += std::string(line) + "\n";
    at = end + 1;
  }
  return chapters;
}

std::string html_of(std::string_view markdown) {
  std::string html;
  const auto append = [](const MD_CHAR* text, MD_SIZE size, void* out) {
    static_cast<std::string*>(out)->append(text, size);
  };
  if (md_html(markdown.data(), static_cast<MD_SIZE>(markdown.size()), append, &html, MD_DIALECT_GITHUB, 0) != 0)
    throw std::runtime_error("a page of docs/ is not Markdown");
  return html;
}

/// As forges do it: `Seen too late` is `seen-too-late`.
std::string anchor_of(std::string_view heading) {
  std::string anchor;
  for (const char letter : heading) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0 || letter == '_' || letter == '-') anchor += static_cast<char>(std::tolower(byte));
    if (letter == ' ') anchor += '-';
  }
  return anchor;
}

/// Calls `change(element, content)` for every `<tag ...>content</tag>`, `tag` with the beginning of what follows it, and puts what it returns in its place.
template <class Change> std::string changed(std::string_view html, std::string_view tag, const Change& change) {
  const std::string open = fmt::format("<{}", tag), close = fmt::format("</{}>", tag.substr(0, tag.find(' ')));
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t start = html.find(open, at), head = html.find('>', start);
    const std::size_t end = html.find(close, start);
    if (start == std::string_view::npos || end == std::string_view::npos) return out += html.substr(at);
    out += html.substr(at, start - at);
    out += change(html.substr(start, head - start), html.substr(head + 1, end - head - 1));
    at = end + close.size();
  }
}

/// Headings a level lower and with anchors of their page, links as `link` turns their address, or their words where it gives
/// none; no pictures, which show other runs.
template <class Link> std::string for_report(std::string html, const std::string& page, const Link& link) {
  for (std::size_t at = 0; (at = html.find("<img", at)) != std::string::npos;)
    html.erase(at, html.find('>', at) - at + 1);
  for (const char* level : {"h3", "h2"}) {
    const std::string lower(1, static_cast<char>(level[1] + 1));
    html = changed(html, level, [&](std::string_view, std::string_view words) {
      return fmt::format("<h{0} id=\"{1}\">{2}</h{0}>", lower, page + "." + anchor_of(words), words);
    });
  }
  html = changed(html, "table", [](std::string_view, std::string_view rows) {  // scrolls where the screen is narrow
    return fmt::format("<div class=\"wide\" tabindex=\"0\"><table>{}</table></div>", rows);
  });
  return changed(html, "a href", [&](std::string_view element, std::string_view words) {
    const std::size_t from = element.find('"') + 1;
    const std::string_view address = element.substr(from, element.find('"', from) - from);
    if (address.starts_with("http")) return fmt::format("{} ({})", words, address);  // a report stands alone
    const std::string target = link(address);
    return target.empty() ? std::string(words) : fmt::format("<a href=\"{}\">{}</a>", target, words);
  });
}

/// The page that a link leads to, and the anchor there; no page if it is not one of docs/.
struct Target {
  std::string page, anchor;
};
Target target_of(std::string_view address, const std::string& own_page) {
  const std::size_t hash = address.find('#');
  const std::string anchor(hash == std::string_view::npos ? "" : address.substr(hash + 1));
  const std::string_view file = address.substr(0, hash);
  if (file.empty()) return {own_page, anchor};
  if (!file.ends_with(".md") || file.find('/') != std::string_view::npos) return {};
  const std::string page(file.substr(0, file.size() - 3));
  return embedded_page(page).empty() ? Target() : Target{page, anchor};
}

bool is_of_another_run(std::string_view heading) { return heading == "Results" || heading == "What to read from it"; }

}  // namespace

Prose prose_of(std::string_view experiment) {
  const std::string own(experiment);
  std::vector<std::string> linked;
  const auto in_report = [&](bool follow, const std::string& page) {
    return [&, follow, page](std::string_view address) -> std::string {
      const Target target = target_of(address, page);
      if (target.page.empty()) return "";
      if (follow && target.page != own && std::ranges::find(linked, target.page) == linked.end())
        linked.push_back(target.page);
      const bool is_there = target.page == own || std::ranges::find(linked, target.page) != linked.end();
      if (!is_there) return "";
      if (target.page == own && target.anchor.empty()) return "#top";
      return "#" + target.page + (target.anchor.empty() ? "" : "." + target.anchor);
    };
  };
  Prose prose;
  for (const Chapter& chapter : chapters_of(embedded_page(experiment))) {
    if (chapter.heading.empty() || is_of_another_run(chapter.heading)) continue;
    const bool is_limits = chapter.heading == "Limits";
    std::string markdown = chapter.markdown;
    if (is_limits) markdown = markdown.substr(markdown.find('\n') + 1);  // the report has a heading for it
    (is_limits ? prose.limits : prose.method) += for_report(html_of(markdown), own, in_report(true, own));
  }
  for (const std::string& page : linked) {
    const std::string_view text = embedded_page(page);
    const std::string_view title = text.substr(2, text.find('\n') - 2);  // after `# `
    std::string html;
    for (const Chapter& chapter : chapters_of(text.substr(text.find('\n') + 1))) {
      if (!is_of_another_run(chapter.heading)) html += html_of(chapter.markdown);
    }
    prose.pages += fmt::format("<details id=\"{}\">\n<summary>{}</summary>\n{}</details>\n", page, html_escaped(title),
                               for_report(html, page, in_report(false, page)));
  }
  return prose;
}

}  // namespace thinwall
