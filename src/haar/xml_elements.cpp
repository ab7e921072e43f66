// SPDX-License-Identifier: BSD-3-Clause
#include "xml_elements.h"

#include <algorithm>
#include <stdexcept>

namespace chain_tracker::haar {
namespace {

class XmlParser {
 public:
  XmlParser(const std::string& xml, const std::string& source) : xml_(xml), source_(source) {}

  XmlElement parse() {
    open_.push_back({});  // holds the root
    while (place_ < xml_.size()) {
      if (xml_[place_] != '<') {
        readText();
      } else if (startsWith("<!--")) {
        skipPast("-->", "a comment does not end");
      } else if (startsWith("<?")) {
        skipPast("?>", "a declaration does not end");
      } else if (startsWith("</")) {
        closeElement();
      } else {
        openElement();
      }
    }
    if (open_.size() > 1) refuse("<" + open_.back().name + "> is not closed");
    if (open_.front().children.size() != 1) refuse("must have one root element");
    return open_.front().children.front();
  }

 private:
  bool startsWith(const char* text) const {
    return xml_.compare(place_, std::string(text).size(), text) == 0;
  }

  void advanceTo(size_t place) {
    line_ += static_cast<int>(std::count(xml_.begin() + static_cast<std::ptrdiff_t>(place_),
                                         xml_.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
    place_ = place;
  }

  void skipPast(const std::string& end, const std::string& fault) {
    const size_t found = xml_.find(end, place_);
    if (found == std::string::npos) refuse(fault);
    advanceTo(found + end.size());
  }

  void readText() {
    const size_t end = std::min(xml_.find('<', place_), xml_.size());
    const std::string text = xml_.substr(place_, end - place_);
    const bool is_blank = text.find_first_not_of(" \t\r\n") == std::string::npos;
    if (!is_blank && open_.size() == 1) refuse("text outside the root element");
    if (open_.size() > 1) open_.back().text += text;
    advanceTo(end);
  }

  void openElement() {
    const size_t end = xml_.find('>', place_);
    if (end == std::string::npos) refuse("a tag does not end");
    const bool is_empty = xml_[end - 1] == '/';
    const size_t name_end = std::min(xml_.find_first_of(" \t\r\n/>", place_ + 1), end);
    XmlElement element;
    element.name = xml_.substr(place_ + 1, name_end - place_ - 1);
    element.line = line_;
    if (element.name.empty()) refuse("a tag has no name");
    if (open_.size() > kMaxXmlDepth) refuse("elements are nested too deeply");
    advanceTo(end + 1);
    open_.push_back(std::move(element));
    if (is_empty) close();
  }

  void closeElement() {
    const size_t end = xml_.find('>', place_);
    if (end == std::string::npos) refuse("a tag does not end");
    const std::string name = xml_.substr(place_ + 2, end - place_ - 2);
    if (open_.size() == 1 || name != open_.back().name) {
      refuse("</" + name + "> closes nothing" +
             (open_.size() > 1 ? ", <" + open_.back().name + "> is open" : ""));
    }
    advanceTo(end + 1);
    close();
  }

  void close() {
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    open_.back().children.push_back(std::move(element));
  }

  [[noreturn]] void refuse(const std::string& reason) const {
    throw std::invalid_argument(source_ + ":" + std::to_string(line_) + ": " + reason);
  }

  const std::string& xml_;
  const std::string& source_;
  size_t place_ = 0;
  int line_ = 1;
  std::vector<XmlElement> open_;
};

}  // namespace

const XmlElement* XmlElement::child(const std::string& child_name) const {
  for (const XmlElement& element : children) {
    if (element.name == child_name) return &element;
  }
  return nullptr;
}

XmlElement parseXml(const std::string& xml, const std::string& source) {
  return XmlParser(xml, source).parse();
}

}  // namespace chain_tracker::haar
