// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/xml.h"

#include "core/error.h"

#include <exception>

#include <expat.h>
#include <fmt/format.h>

namespace weft::mesh {
namespace {

constexpr std::size_t deepest = 64;  // a 3MF needs about six levels

/// What the callbacks of expat share. They are called through C, so what they throw is kept until expat has returned.
struct State {
  XML_Parser parser;
  const XmlEvents& events;
  const std::string& where;
  std::size_t depth = 0;
  std::exception_ptr thrown{};

  bool is_of_text(std::string_view name) const { return name.substr(name.rfind('|') + 1) == events.text_in; }
  std::size_t line() const { return XML_GetCurrentLineNumber(parser); }
  Error error(std::string what, std::string hint) const {
    return {Error::Kind::model, std::move(what), fmt::format("{}:{}", where, line()), std::move(hint)};
  }
};

template <class F>
void guarded(void* data, F f) noexcept {
  State& state = *static_cast<State*>(data);
  if (state.thrown) return;
  try {
    f(state);
  } catch (...) {
    state.thrown = std::current_exception();
    XML_StopParser(state.parser, XML_FALSE);
  }
}

void XMLCALL on_text(void* data, const XML_Char* piece, int size) {
  guarded(data, [&](State& state) { state.events.text({piece, static_cast<std::size_t>(size)}); });
}

void XMLCALL on_start(void* data, const XML_Char* name, const XML_Char** attributes) {
  guarded(data, [&](State& state) {
    if (++state.depth > deepest) throw state.error("XML nested too deeply", "no model is: do not trust the file");
    if (state.events.start) state.events.start(name, XmlAttributes(attributes), state.line());
    if (state.events.text && state.is_of_text(name)) XML_SetCharacterDataHandler(state.parser, on_text);
  });
}

void XMLCALL on_end(void* data, const XML_Char* name) {
  guarded(data, [&](State& state) {
    --state.depth;
    if (state.events.text) XML_SetCharacterDataHandler(state.parser, nullptr);
    if (state.events.end) state.events.end(name);
  });
}

void XMLCALL on_prefix(void* data, const XML_Char* prefix, const XML_Char* uri) {
  guarded(data, [&](State& state) {
    if (state.events.prefix) state.events.prefix(prefix ? prefix : "", uri ? uri : "");
  });
}

void XMLCALL on_document_type(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  guarded(data, [](State& state) {
    throw state.error("XML with a document type, which a 3MF must not have", "do not trust the file");
  });
}

}  // namespace

std::optional<std::string_view> XmlAttributes::find(std::string_view name) const {
  for (const char* const* at = list_; *at; at += 2)
    if (name == *at) return at[1];
  return std::nullopt;
}

void parse_xml(Archive& archive, const std::string& part, const std::string& path, const XmlEvents& events) {
  struct Freeing {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };
  const std::unique_ptr<XML_ParserStruct, Freeing> parser(XML_ParserCreateNS(nullptr, '|'));
  if (!parser) throw std::bad_alloc();
  const std::string where = path + "/" + part;
  State state{parser.get(), events, where};
  XML_SetUserData(parser.get(), &state);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetStartNamespaceDeclHandler(parser.get(), on_prefix);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_document_type);
  const auto feed = [&](std::string_view piece, bool last) {
    const auto status = XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()), last);
    if (state.thrown) std::rethrow_exception(state.thrown);
    if (status != XML_STATUS_OK)
      throw state.error(fmt::format("XML: {}", XML_ErrorString(XML_GetErrorCode(parser.get()))),
                        "export the model again");
  };
  archive.read(part, [&](std::string_view piece) { feed(piece, false); });
  feed({}, true);
}

}  // namespace weft::mesh
