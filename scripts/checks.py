"""What the check_*.py share: options, lines of value and limit that pass or fail, their JSON, the exit status."""

import argparse
import json
import math
import os


def options_of(name, text, groups, quick, more=None):
    """Parsed options, and the groups that --only asks for or None. `more` adds what one check alone takes."""
    parser = argparse.ArgumentParser(description=text)
    parser.add_argument("--build", default="build")
    parser.add_argument("--out", default=f"out/{name}")
    parser.add_argument("--json", help=f"where the lines go (default: {name}.json in the folder)")
    parser.add_argument("--only", help=f"comma-separated: {', '.join(groups)}")
    parser.add_argument("--quick", action="store_true", help=quick)
    if more:
        more(parser)
    options = parser.parse_args()
    options.json = options.json or os.path.join(options.out, f"{name}.json")
    only = options.only.split(",") if options.only else None
    if only and not set(only) <= set(groups):
        parser.error(f"--only: expected some of {', '.join(groups)}")
    return options, only


class Check:
    digits = 3  # of a number as it is printed

    def __init__(self, options):
        self.build, self.out = os.path.abspath(options.build), os.path.abspath(options.out)
        self.welkin, self.quick = os.path.join(self.build, "welkin"), options.quick
        self.group, self.lines, self.details = "", [], {}
        os.makedirs(self.out, exist_ok=True)

    def line(self, name, value, limit, ok, published=None, digits=None):
        if isinstance(value, float) and not math.isfinite(value):
            value = "not finite"
        self.lines.append({"group": self.group, "name": name, "value": value, "limit": limit, "pass": bool(ok),
                           **({"published": published} if published else {})})
        text = f"{value:.{digits or self.digits}g}" if isinstance(value, float) else f"{value}"
        print(f"{'pass' if ok else 'FAIL'}  {name}: {text} ({limit}{f'; best published {published}' if published else ''})", flush=True)

    def at_most(self, name, value, limit, published=None):
        """`value` None: it was not measured, which is a failure."""
        self.line(name, "not measured" if value is None else value, f"at most {limit:g}", value is not None and value <= limit, published)

    def at_least(self, name, value, limit):
        self.line(name, value, f"at least {limit:g}", value >= limit)

    def run_groups(self, groups, wanted):
        for group in wanted:
            self.group = group
            groups[group](self)

    def failed(self):
        return sum(not line["pass"] for line in self.lines)

    def write(self, path, report, text=lambda report: json.dumps(report, indent=1) + "\n"):
        """The report, whole or not at all. Returns the exit status: a check without a line has shown nothing."""
        os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
        with open(path + ".new", "w", encoding="utf-8") as f:
            f.write(text(report))
        os.replace(path + ".new", path)
        print(f"{len(self.lines) - self.failed()} of {len(self.lines)} lines hold; {os.path.relpath(path)}")
        return 1 if self.failed() or not self.lines else 0
