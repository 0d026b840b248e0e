// Each display gets a button that copies it as LaTeX. The page also works without this script.
for (const display of document.querySelectorAll(".display[data-tex]")) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "copy";
  button.textContent = "<< labels.web.copy_latex >>";
  button.addEventListener("click", async () => {
    await navigator.clipboard.writeText(display.dataset.tex);
    button.textContent = "<< labels.web.copied >>";
    setTimeout(() => { button.textContent = "<< labels.web.copy_latex >>"; }, 1500);
  });
  display.append(button);
}
