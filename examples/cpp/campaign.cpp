// Fly a campaign, then its worst members once more, alone: campaign
// models/gallery/dispersed_burn.yaml
#include <twincraft/campaign.h>

#include <cstdio>

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  const auto model = twincraft::Model::load(argv[1]);
  const twincraft::Campaign campaign = model.campaign();
  std::printf("%zu members, %s\n", campaign.rows(), campaign.verdict().c_str());
  for (const std::size_t member : campaign.worst(3)) {
    const twincraft::Run run = model.member(member).run();
    std::printf("member %zu: %s\n", member, run.verdict().c_str());
  }
} catch (const twincraft::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
