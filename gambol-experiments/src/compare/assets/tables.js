// Small pieces of the page: numbers as text, tables, and figures with their numbers.

// A method's colour; with more methods than colours they come again, dashed.
function methodClass(place) { return place === null ? "no-method" : `method-${place % 8}${place < 8 ? "" : " again"}`; }

// How many decimals show differences of a hundredth of the range.
function decimalsOf(values) {
  const usable = values.filter(value => Number.isFinite(value));
  let hundredth = (Math.max(...usable) - Math.min(...usable)) / 100;
  if (!(hundredth > 0)) return 2;
  let decimals = 0;
  for (; hundredth < 0.5 && decimals < 6; hundredth *= 10) decimals++;
  return decimals;
}

function pValue(p) { return p < 0.0001 ? "<\u00a00.0001" : fixed(p, p < 0.1 ? 4 : 2); }

function intervalText(interval, decimals) {
  return interval ? `${fixed(interval[0], decimals)} to ${fixed(interval[1], decimals)}` : "–";
}

function listed(words) {
  return words.length < 2 ? words.join("") : `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;
}

// Seconds as a reader says them.
function duration(seconds) {
  if (seconds === null) return "–";
  return seconds >= 7200 ? `${fixed(seconds / 3600, 1)} h` : seconds >= 120 ? `${fixed(seconds / 60, 1)} min` : `${fixed(seconds, 1)} s`;
}

// A table that scrolls where it does not fit. The first cell of a row names it: a text, or { text, method } with the
// method's colour. `words` are the columns of words.
function table(title, header, rows, words = []) {
  const made = element("table");
  if (title) made.append(element("caption", title));
  const head = made.createTHead().insertRow();
  header.forEach((text, column) => {
    const cell = element("th", text, words.includes(column) ? "words" : "");
    cell.scope = "col";
    head.append(cell);
  });
  const body = made.createTBody();
  for (const row of rows) {
    const line = body.insertRow();
    row.forEach((value, column) => {
      const cell = element(column ? "td" : "th", undefined, words.includes(column) ? "words" : "");
      if (column === 0) {
        cell.scope = "row";
        if (value.method !== undefined) {
          cell.className = methodClass(value.method);
          cell.append(element("i"));
        }
        cell.append(value.text ?? value);
      } else if (value.strong) {
        cell.append(element("strong", value.strong));
      } else {
        cell.textContent = value;
      }
      line.append(cell);
    });
  }
  const scroll = element("div", undefined, "scroll");
  scroll.tabIndex = 0;
  scroll.setAttribute("role", "region");
  scroll.setAttribute("aria-label", title || header.join(", "));
  scroll.append(made);
  return scroll;
}

function folded(summary, ...content) {
  const details = element("details", undefined, "numbers");
  details.append(element("summary", summary), ...content);
  return details;
}

// A figure with a title, a line on what it shows, a place for the chart, and its numbers. `level`: of the title.
function figure(level, title, text, chart, ...numbers) {
  const made = element("figure");
  const caption = element("figcaption");
  caption.append(element(level, title));
  if (text) caption.append(element("p", text, "quiet"));
  made.append(caption, chart, ...numbers);
  return made;
}
