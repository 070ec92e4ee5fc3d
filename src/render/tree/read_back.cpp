// The resident tree, copied from the GPU.
#include "render/tree/resident_tree.h"

namespace welkin {

TreeData ResidentTree::readBack() const {
  TreeData data;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  block_.download(0, std::as_writable_bytes(std::span(&data.block, 1)));
  data.nodes.resize((words_.bytes() - nodeOffset(0)) / sizeof(shared::NodeWords));
  words_.download(nodeOffset(0), std::as_writable_bytes(std::span(data.nodes)));
  data.chords.resize(chords_.bytes() / sizeof(data.chords[0]));
  chords_.download(0, std::as_writable_bytes(std::span(data.chords)));
  for (const gpu::Texture& texture : bricks_) {
    const auto& spec = texture.spec();
    auto& texels = data.bricks.emplace_back(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.depth) * 2);
    glGetTextureImage(texture.id(), 0, GL_RG, GL_UNSIGNED_SHORT, GLsizei(texels.size() * sizeof(std::uint16_t)), texels.data());
  }
  return data;
}

}  // namespace welkin
