"""Numbers and tables as text."""


def number(value):
    """Three significant digits, without an exponent."""
    if value == 0:
        return "0"
    digits = 2
    while digits > 0 and abs(value) >= 10 ** (3 - digits):
        digits -= 1
    if abs(value) < 0.1:
        return f"{value:.3g}"
    return f"{value:.{digits}f}"


def percent(share):
    return "" if share is None else f"{100 * share:.0f} %"


def optional(value):
    return "" if value is None else number(value)


def markdown(header, body, left=1):
    """A table; the first `left` columns are aligned to the left, all others to the right."""
    lines = ["| " + " | ".join(header) + " |",
             "|" + "---|" * left + "---:|" * (len(header) - left)]
    lines += ["| " + " | ".join(cells) + " |" for cells in body]
    return "\n".join(lines)
