// The preview: when the page changes, its content is replaced, and the scroll position is kept.
const name = document.querySelector("main").dataset.name;
const complaints = document.getElementById("complaints");
const heading = complaints.querySelector("h2");
const wrong = heading.textContent;
const events = new EventSource(`/${name}/events`);

function placeOf(main) {
  const seen = [...main.querySelectorAll("section, .row[id], h1")].find((each) => each.getBoundingClientRect().bottom > 0);
  return seen && seen.id ? { id: seen.id, top: seen.getBoundingClientRect().top } : { y: scrollY };
}

function show(html) {
  const main = document.querySelector("main");
  if (main.innerHTML.trim() === html.trim()) return;
  const place = placeOf(main);
  const open = [...main.querySelectorAll("details")].map((each) => each.open);
  main.innerHTML = html;
  [...main.querySelectorAll("details")].forEach((each, i) => { each.open = open[i] ?? false; });
  const again = place.id && document.getElementById(place.id);
  if (again) scrollBy(0, again.getBoundingClientRect().top - place.top); else if (place.y !== undefined) scrollTo(0, place.y);
}

events.onmessage = (event) => {
  const said = JSON.parse(event.data);
  if (said.main) show(said.main);
  complaints.hidden = said.complaints.length === 0;
  heading.textContent = document.querySelector("main").innerHTML.trim() ? wrong : heading.dataset.first;
  complaints.querySelector("pre").textContent = said.complaints.join("\n\n");
  document.body.dataset.edition = Number(document.body.dataset.edition || 0) + 1;
};
events.onerror = () => {
  complaints.hidden = false;
  complaints.querySelector("pre").textContent = "<< labels.web.ended >>";
};
