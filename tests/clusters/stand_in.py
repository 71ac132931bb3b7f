#!/usr/bin/env python3
"""What a cluster sees of scsim flying a campaign, without the flying:

  scsim SPEC -o DIR [--shard I/N] [--resume] [--jobs N] [--quiet]
  scsim merge DIR

SPEC is JSON: members, and the seconds that each takes. A shard's part is a line per member, so that a kill
loses the one in flight; SIGTERM ends it with 143."""

from __future__ import annotations

import argparse
import json
import signal
import sys
import time
from pathlib import Path


def fly(spec: Path, folder: Path, shard: str, resume: bool) -> int:
    campaign = json.loads(spec.read_text())
    number, shards = map(int, shard.split("/"))
    if not 1 <= number <= shards:
        return 2
    folder.mkdir(exist_ok=True)
    (folder / "members").write_text(str(campaign["members"]))
    part = folder / f"shard_{number}_of_{shards}.csv"
    finished = records(part) if resume and part.exists() else {}
    with part.open("w") as file:
        file.writelines(finished.values())
        for member in range(number - 1, campaign["members"], shards):
            if member in finished:
                continue
            print("flies", member, flush=True)
            time.sleep(campaign["seconds"])
            file.write(f"{member},{member / 7!r}\n")
            file.flush()
    return 0


def records(part: Path) -> dict[int, str]:
    """The lines of a part by member; a torn one is none."""
    lines = part.read_text().splitlines(keepends=True)
    return {int(line.partition(",")[0]): line for line in lines if line.endswith("\n")}


def merge(folder: Path) -> int:
    merged: dict[int, str] = {}
    for part in folder.glob("shard_*.csv"):
        merged |= records(part)
    (folder / "campaign.csv").write_text("".join(merged[member] for member in sorted(merged)))
    return 0 if len(merged) == int((folder / "members").read_text()) else 1


def main() -> int:
    if sys.argv[1] == "merge":
        return merge(Path(sys.argv[2]))
    parser = argparse.ArgumentParser()
    parser.add_argument("spec", type=Path)
    parser.add_argument("-o", dest="folder", type=Path, required=True)
    parser.add_argument("--shard")
    parser.add_argument("--resume", action="store_true")
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--quiet", action="store_true")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    status = fly(options.spec, options.folder, options.shard or "1/1", options.resume)
    return status if options.shard or status else merge(options.folder)


if __name__ == "__main__":
    sys.exit(main())
