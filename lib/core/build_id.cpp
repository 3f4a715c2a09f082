// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/build_id.h"

#include "core/version.h"

#include <cstring>

#include <elf.h>
#include <link.h>

namespace weft {
namespace {

/// Takes the build id of the first object listed, which is the program itself, and stops there.
int take_build_id(dl_phdr_info* info, std::size_t, void* out) {
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& segment = info->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const char* at = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
    const char* const end = at + segment.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const char* const name = at + sizeof note;
      const char* const bytes = name + (note.n_namesz + 3) / 4 * 4;
      if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(name, "GNU", 4) == 0) {
        constexpr const char* hex = "0123456789abcdef";
        for (std::size_t b = 0; b < note.n_descsz; ++b) {
          const auto byte = static_cast<unsigned char>(bytes[b]);
          static_cast<std::string*>(out)->append({hex[byte >> 4], hex[byte & 15]});
        }
        return 1;
      }
      at = bytes + (note.n_descsz + 3) / 4 * 4;
    }
  }
  return 1;
}

}  // namespace

const std::string& build_id() {
  static const std::string id = [] {
    std::string linked;
    ::dl_iterate_phdr(take_build_id, &linked);
    return std::string(version) + " " + linked;
  }();
  return id;
}

}  // namespace weft
