// The page of a preregistration.
#include "core/text.h"
#include "study/html/html.h"
#include "study/preregistration/preregistration.h"

namespace chironomia::study {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Preregistration: {}</title>
<style>
body {{ font: 16px/1.5 system-ui, sans-serif; max-width: 44rem; margin: 2rem auto; padding: 0 1rem; color: #1b1f24; }}
h2 {{ margin-top: 2.5rem; border-bottom: 1px solid #d0d7de; }}
h3 {{ margin-bottom: 0.25rem; }}
p {{ margin: 0.25rem 0; }}
.said {{ border-inline-start: 3px solid #0550ae; padding-inline-start: 0.75rem; }}
.missing {{ color: #a40e26; font-weight: 600; }}
pre {{ white-space: pre-wrap; overflow-wrap: anywhere; font-size: 0.8125rem; }}
</style></head><body>
<h1>{}</h1>
<p>A preregistration in the order of OSF's form, made of the plan by chironomia {}. Plain text follows from the plan and
the program; text with a bar is written in the plan by its people. {} of {} items are not complete.</p>
)";

// Inside of a script nothing may look like its end.
std::string script_text(const Json& json) {
    std::string text = json.dump(1);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at))
        text.replace(at, 1, "\\u003c");
    return text;
}

std::string paragraphs(const std::vector<std::string>& texts, const std::string& kind) {
    std::string html;
    for (const std::string& text : texts) html += format("<p class=\"{}\">{}</p>\n", kind, escape_html(text));
    return html;
}

}  // namespace

std::string preregistration_page(const Preregistration& preregistration) {
    std::size_t missing = 0;
    for (const PreregistrationItem& item : preregistration.items) missing += !item.missing.empty();
    const std::string title = escape_html(preregistration.title);
    std::string html = format(kHead, title, title, preregistration.data.at("program").get<std::string>(),
                              missing, preregistration.items.size());
    std::string section;
    for (const PreregistrationItem& item : preregistration.items) {
        if (item.section != section) html += format("<h2>{}</h2>\n", item.section);
        section = item.section;
        html += format("<h3>{}</h3>\n", item.title) + paragraphs(item.said, "said") +
                paragraphs(item.fixed, "fixed");
        if (!item.missing.empty()) html += paragraphs({item.missing}, "missing");
    }
    html += format(
        "<h2>The plan</h2>\n<p>SHA-256 of the plan as used, as JSON on one line: <code>{}</code></p>\n",
        preregistration.data.at("plan_sha256").get<std::string>());
    html += format("<details><summary>The plan as used</summary><pre>{}</pre></details>\n",
                   escape_html(preregistration.data.at("plan").dump(2)));
    html += format("<script type=\"application/json\" id=\"preregistration\">{}</script>\n",
                   script_text(preregistration.data));
    return html + "</body></html>\n";
}

}  // namespace chironomia::study
