// What the explorer's page does in the browser itself: uploads, downloads and the link.
window.wingbeatPage = {
  // Send a file; return why it was refused, nothing if it was taken.
  async upload(input, session) {
    const file = input.files[0];
    if (!file) return "";
    input.value = "";
    const refused = `${file.name.slice(-60)} was refused: a file may have at most 5 million bytes.`;
    if (file.size > 5_000_000) return refused;
    try {
      const address = `/wingbeat/upload/${session}?name=${encodeURIComponent(file.name)}`;
      const answer = await fetch(address, { method: "POST", body: file });
      return answer.ok ? "" : await answer.text();
    } catch {
      return "The file could not be sent; is the server still running?";
    }
  },
  download(address) {
    const link = Object.assign(document.createElement("a"), { href: address, download: "" });
    document.body.append(link);
    link.click();
    link.remove();
  },
  setQuery(query) {
    history.replaceState(null, "", `${location.pathname}?${query}`);
  },
  async copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
    } catch {
      window.prompt("The link of this page:", location.href);
    }
  },
};

// While a text is typed but not entered yet, the answer belongs to an earlier request.
const typing = (is) => (event) => {
  if (event.target.matches?.('.side input[type="text"]')) document.body.classList.toggle("typing", is);
};
document.addEventListener("input", typing(true));
document.addEventListener("change", typing(false));
document.addEventListener("focusout", typing(false));
