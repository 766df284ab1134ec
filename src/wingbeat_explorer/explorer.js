// wingbeat explorer, made by viewer/build.mjs; sources sha256:9cf15d8278ffd5c2bc8e8b6b3883aa2399705c153338efa404bc651e6a66b6b1
(()=>{var{Viewer:ut,Flight:ft,setView:mt,viewOf:wt,make:h,draw:w,capital:M,short:x,ticks:rt,mount:gt}=globalThis.wingbeatViewer;var v={name:"speed",unit:"m/s",label:"speed"};function y(s,t,e=3){return t?`${x(s,e)} ${t}`:x(s,e)}function bt({speed:s,axis:t=v,...e}){let i=t.name===v.name?"":`, ${t.label} ${y(e[t.name],t.unit)}`;return`at ${x(s)} m/s${i}`}function L(s){return Array.isArray(s)?s:[s,s]}var B=s=>s.plausible===!1;function xt(s){return s.certified?s.plausible===null?"certified, plausibility not known":`certified, ${s.plausible?"plausible":"not plausible"}`:"no certified wingbeat"}var m={left:46,right:16,top:14,bottom:38};function vt(s,t){let{axis:e,x:i,y:n,width:a,height:o,xTicks:r,yTicks:l}=s,c=o-m.bottom,p=(d,f,u,b,A="wbx-tick")=>w("text",{x:d,y:f,"text-anchor":u,class:A},b);return w("g",{"aria-hidden":"true"},...l.flatMap(d=>[w("line",{class:"wbx-grid",x1:m.left,x2:a-m.right,y1:n(d),y2:n(d)}),p(m.left-7,n(d)+4,"end",String(d))]),...r.map(d=>p(i(d),c+16,"middle",String(d))),w("line",{class:"wbx-axis",x1:m.left,x2:a-m.right,y1:c,y2:c}),p(a-m.right,c+31,"end",e.unit==="1"?e.label:`${e.label} [${e.unit}]`),p(m.left+2,m.top-3,"start",`${t.label} [${t.unit}]`))}function yt(s,{axis:t,x:e,y:i},n){let a=[];for(let o=1;o<s.length;o++){let[r,l]=[s[o-1],s[o]];if(!r.certified||!l.certified)continue;let c=[r,l].some(B)?"wbx-curve wbx-dashed":"wbx-curve",p={x1:e(r[t.name]),y1:i(r[n]),x2:e(l[t.name]),y2:i(l[n])};a.push(w("line",{class:c,...p}))}return w("g",{},...a)}function kt(s,{axis:t,x:e,y:i,height:n},a){let o=s.map(r=>{let l=e(r[t.name]);return r.certified?w("circle",{class:B(r)?"wbx-dot wbx-hollow":"wbx-dot",cx:l,cy:i(r[a]),r:4}):be(l,n-m.bottom-9)});return w("g",{},...o)}function $t(s,{x:t,height:e}){let i=e-m.bottom;return w("g",{},...s.map(n=>w("circle",{class:"wbx-pending",cx:t(n),cy:i,r:4})))}function be(s,t){return w("path",{class:"wbx-gap",d:`M${s-4} ${t-4}l8 8m0-8l-8 8`})}function Tt(s,{x:t,y:e,height:i,width:n},a,o){let[r,l]=L(s.speed).map(t),[c,p]=s[a]===void 0?[]:L(s[a]).map(e),d=`${s.label}. Source: ${s.source}`,f={class:`wbx-measured wbx-${s.basis??"measured"}`,tabindex:"0",role:"img","aria-label":d,onpointerenter:()=>o(d),onpointerleave:()=>o(""),onfocus:()=>o(d),onblur:()=>o("")},u=p??m.top,b=c??i-m.bottom,A=Math.max(l-r,10),C=Math.max(b-u,10),P={x:Math.min((r+l-A)/2,n-m.right-A),y:(u+b-C)/2,width:A,height:C,rx:3};return w("g",f,w("rect",P))}var xe=400;function At({title:s,points:t},e,{x:i,y:n,height:a},{name:o,unit:r},l){let c=t.filter(u=>u[o]!==void 0),p=c.length<=xe,d=c.map(u=>{let[b,A]=[i(u.speed),n(u[o])],C=u[`${o}Error`],E=Math.min(n(u[o]-C),a-m.bottom),P=C?[w("path",{d:`M${b} ${n(u[o]+C)}V${E}`})]:[],U=w("path",{class:"wbx-own-mark",d:`M${b} ${A-5}l5 5l-5 5l-5 -5z`});if(!p)return w("g",{},...P,U);let H=`${u.label||s}: ${y(u[o],r)} at ${y(u.speed,"m/s")}.`;return w("g",{onpointerenter:()=>l(H),onpointerleave:()=>l("")},...P,U)}),f=`${s}: ${c.length} measured points of your own`;return w("g",{class:`wbx-own wbx-own-${e%3}`,role:"img","aria-label":f},...d)}var V=[{name:"power",label:"Power",unit:"W"},{name:"frequency",label:"Wingbeats",unit:"Hz"}],ve={ArrowRight:1,ArrowUp:1,ArrowLeft:-1,ArrowDown:-1,PageUp:3,PageDown:-3},ye=.5,G=class{constructor(t,e){this.act=t,this.onslide=()=>{},this.snap=e,this.quantity=V[0],this.data={points:[],measured:[],pending:[]},this.own=[],this.axis=v,this.at=0,this.svg=w("svg",{class:"wbx-chart"}),this.buttons=V.map(a=>h("button",{type:"button","aria-pressed":"false",onclick:()=>this.choose(a)},a.label));let i=h("div",{class:"wbx-pair",role:"group","aria-label":"Curve shown"},...this.buttons);this.note=h("p",{class:"wbx-note"}),this.title=h("h2");let n=h("div",{class:"wbx-row"},this.title,i);this.element=h("div",{class:"wbx-curve-box","data-part":"curve"},n,this.svg,this.note),this.buildHandle(),this.svg.addEventListener("pointerdown",a=>this.take(a)),this.svg.addEventListener("pointermove",a=>this.dragging&&this.drag(a));for(let a of["pointerup","pointercancel"])this.svg.addEventListener(a,()=>this.release());this.watcher=new ResizeObserver(()=>this.draw()),this.watcher.observe(this.svg),this.turn(v),this.choose(V[0])}turn(t){this.axis=t;let e=t.name===v.name;this.title.textContent=e?"Drag the point to fly faster or slower":`Drag the point to change the ${t.label}`,this.handle.setAttribute("aria-label",M(t.label))}buildHandle(){this.guide=w("line",{class:"wbx-guide"}),this.knob=w("circle",{class:"wbx-knob",r:9}),this.tag=w("text",{class:"wbx-tag","text-anchor":"middle"});let t={role:"slider",tabindex:"0","aria-orientation":"horizontal"};this.handle=w("g",{class:"wbx-handle",...t},this.guide,this.knob,this.tag),this.handle.addEventListener("keydown",e=>this.key(e))}choose(t){this.quantity=t,this.buttons.forEach((e,i)=>e.setAttribute("aria-pressed",String(V[i]===t))),this.draw()}show({points:t,measured:e=[],range:i,pending:n=[]},a=v){this.turn(a);let o=[...t].sort((r,l)=>r[a.name]-l[a.name]);this.data={points:o,measured:e,range:i,pending:n},this.draw()}showOwn(t){this.own=t,this.draw()}mark(t){this.dragging||(this.at=t,this.place(t))}pin(t){t!==this.pinned&&(this.pinned=t,this.draw())}draw(){let{clientWidth:t,clientHeight:e}=this.svg;if(!t||!e)return;let{name:i}=this.quantity,{points:n}=this.data,a=c=>i==="power"&&c.frequency===void 0,o=this.data.measured.filter(c=>c[i]!==void 0||a(c));this.scale=this.scales(t,e,o),this.svg.setAttribute("viewBox",`0 0 ${t} ${e}`);let r=c=>this.note.textContent=c||this.legend(o),l=document.activeElement===this.handle;this.svg.replaceChildren(vt(this.scale,this.quantity),...o.map(c=>Tt(c,this.scale,i,r)),...this.drawn.map((c,p)=>At(c,p,this.scale,this.quantity,r)),yt(n,this.scale,i),$t(this.data.pending,this.scale),kt(n,this.scale,i),...this.drawPin(i),this.handle),l&&this.handle.focus({preventScroll:!0}),r(""),this.place(this.at)}get drawn(){return this.axis.name===v.name?this.own:[]}scales(t,e,i){let{points:n}=this.data,{name:a}=this.quantity,{axis:o}=this,r=[...n.map(g=>g[o.name]),...this.data.range??[]],[l,c]=r.length?[Math.min(...r),Math.max(...r)]:[0,20],p=this.drawn.flatMap(g=>g.points),d=p.map(g=>g.speed),f=[l,c,...i.flatMap(({speed:g})=>L(g)),...d],u=Math.max(.04*(c-l),.02*Math.abs(c))||.2,b=Math.min(...f),[A,C]=[b<0?b-u:Math.max(b-u,0),Math.max(...f)+u],E=n.filter(g=>g.certified).map(g=>g[a]),P=i.filter(g=>g[a]!==void 0).map(g=>L(g[a])[1]),U=p.filter(g=>g[a]!==void 0).map(g=>g[a]),H=1.12*Math.max(...E,...P,...U,1e-9),fe=g=>m.left+(g-A)/(C-A)*(t-m.left-m.right),me=g=>e-m.bottom-g/H*(e-m.bottom-m.top),we=g=>A+(g-m.left)/(t-m.left-m.right)*(C-A),ge=rt(A,C,t<500?5:10);return{axis:o,x:fe,y:me,width:t,height:e,valueAt:we,first:l,last:c,xTicks:ge,yTicks:rt(0,H,4)}}drawPin(t){if(this.pinned?.[this.axis.name]===void 0)return[];let{x:e,y:i}=this.scale,[n,a]=[e(this.pinned[this.axis.name]),i(this.pinned[t])];return[w("path",{class:"wbx-pin",d:`M${n} ${a-8}l8 8l-8 8l-8 -8z`})]}legend(t){let{points:e}=this.data,i=[];return e.some(n=>n.certified&&B(n))&&i.push("dashed: not plausible"),e.some(n=>!n.certified)&&i.push("cross: no certified wingbeat"),this.data.pending.length&&i.push("rings on the axis: still to be computed"),t.length&&i.push("bars behind: real animals (point at one for its source)"),i.join("; ")}place(t){if(!this.scale)return;let{x:e,y:i,height:n,first:a,last:o}=this.scale,{name:r,unit:l}=this.quantity,c=e(Math.min(Math.max(t,a),o)),p=this.heightAt(t,r),d=n-m.bottom,f=p===void 0?d-9:i(p);for(let[C,E]of Object.entries({x1:c,x2:c,y1:f,y2:d}))this.guide.setAttribute(C,E);this.knob.setAttribute("cx",c),this.knob.setAttribute("cy",f),this.tag.setAttribute("x",c),this.tag.setAttribute("y",f<m.top+20?f+26:f-16);let u=this.nearest(t),b=u&&Math.abs(u[this.axis.name]-t)<1e-9?u:void 0;this.tag.textContent=b?.certified&&!this.dragging?`${x(b[r])} ${l}`:"",this.handle.setAttribute("aria-valuemin",a),this.handle.setAttribute("aria-valuemax",o),this.handle.setAttribute("aria-valuenow",t);let A=b?.certified?`${x(b.power)} W, ${x(b.frequency)} Hz, `:"";this.handle.setAttribute("aria-valuetext",y(t,this.axis.unit)+(b?`: ${A}${xt(b)}`:""))}heightAt(t,e){let{points:i}=this.data,n=c=>c[this.axis.name],a=i.findIndex(c=>n(c)>=t-1e-9);if(a<0)return;let[o,r]=[i[a],i[a-1]];if(Math.abs(n(o)-t)<1e-9)return o.certified?o[e]:void 0;if(!r?.certified||!o.certified)return;let l=(t-n(r))/(n(o)-n(r));return r[e]+l*(o[e]-r[e])}nearest(t){let e=i=>Math.abs(i[this.axis.name]-t);return this.data.points.reduce((i,n)=>i&&e(i)<=e(n)?i:n,void 0)}take(t){t.button!==0||!this.scale||(this.dragging=!0,this.svg.setPointerCapture(t.pointerId),this.handle.focus({preventScroll:!0}),this.drag(t))}drag(t){let{first:e,last:i,valueAt:n}=this.scale,a=t.clientX-this.svg.getBoundingClientRect().left,o=Math.min(Math.max(n(a),e),i);this.place(o),this.ask(this.snap?this.nearest(o)?.[this.axis.name]:Math.round(10*o)/10),this.onslide(o)}release(){this.dragging&&(this.dragging=!1,this.place(this.at),this.onslide())}key(t){let e=ve[t.key],i={Home:"first",End:"last"}[t.key];!e&&!i||t.ctrlKey||t.metaKey||t.altKey||!this.scale||(t.preventDefault(),t.stopPropagation(),i?this.ask(this.scale[i]):this.snap?this.ask(this.beside(e)):this.ask(Math.min(Math.max(this.at+e*ye,this.scale.first),this.scale.last)),this.place(this.at))}beside(t){let{points:e}=this.data,i=e.indexOf(this.nearest(this.at));return e[Math.min(Math.max(i+t,0),e.length-1)]?.[this.axis.name]}ask(t){t===void 0||t===this.at||(this.at=t,this.act(t))}destroy(){this.watcher.disconnect()}};var St=2,K=class{constructor(){this.rows=new Map,this.element=h("ul",{class:"wbx-gauges","aria-label":"Numbers and their plausible ranges"})}show(t,e){let i=new Map((e??[]).map(o=>[o.name,o]));for(let o of t)this.rows.has(o.name)||this.rows.set(o.name,new ht),this.rows.get(o.name).show(o,i.get(o.name));let n=t.map(({name:o})=>this.rows.get(o).element);n.length===this.element.children.length&&n.every((o,r)=>o===this.element.children[r])||this.element.replaceChildren(...n)}},ht=class{constructor(){this.label=h("span",{class:"wbx-label"}),this.value=h("span",{class:"wbx-value"}),this.word=h("span",{class:"wbx-word"}),this.band=h("span",{class:"wbx-band"}),this.mark=h("span",{class:"wbx-mark"}),this.pinned=h("span",{class:"wbx-mark wbx-was"}),this.bar=h("span",{class:"wbx-bar","aria-hidden":"true"},this.band,this.pinned,this.mark),this.range=h("p"),this.source=h("p");let t=h("summary",{},this.label,this.value,this.word,this.bar);this.element=h("li",{},h("details",{},t,this.range,this.source))}show(t,e){let{label:i,value:n,unit:a,low:o,high:r,source:l}=t,c=o!==null||r!==null;this.element.dataset.gauge=t.name,this.label.textContent=i,this.value.textContent=n===null?"\u2013":y(n,a),this.value.dataset.exact=n,this.word.textContent=ke(t),this.element.className={true:"wbx-inside",false:"wbx-outside"}[t.inside]??"";let p=t.given?"Given, not predicted. ":"";this.range.textContent=p+(c?`Plausible: ${$e(t)}`:"No plausible range is known."),this.source.textContent=c?`Source: ${l}`:"";let d=r!==null?St*r:2.5*o,f=o!==null&&o<0?St*o:0,u=b=>`${100*Math.min(Math.max((b-f)/(d-f),0),1)}%`;this.bar.hidden=!c,c&&(this.band.style.left=u(o??f),this.band.style.right=`calc(100% - ${u(r??d)})`,this.put(this.mark,n,f,d,u),this.put(this.pinned,e?.value??null,f,d,u))}put(t,e,i,n,a){t.hidden=e===null,e!==null&&(t.style.left=a(e),t.classList.toggle("wbx-beyond",e>n||e<i))}};function ke({value:s,low:t,high:e,inside:i,limited:n,given:a}){return s===null?"not defined":t===null&&e===null?a?"given":"no range known":i?a?"given":n?"set by a limit":"inside":e!==null&&s>e?"above":"below"}function $e({low:s,high:t,unit:e}){return s===null?`at most ${y(t,e)}`:t===null?`at least ${y(s,e)}`:`${y(s,"")} to ${y(t,e)}`}var Y=class{constructor(t){this.face=t,this.wanted=""}get name(){return this.wanted||(this.face.viewer?.pushes.name??"")}want(t){this.wanted=t}heard(){let{answer:t,viewer:e}=this.face;if(!(!this.wanted||!t||t.provisional))if(!e||!this.face.isPushed(t))this.wanted="";else if(!t.scene.pushes)this.face.onpush();else{let{wanted:i}=this;this.wanted="",e.pushes.open(i),this.face.onpushed()}}};var X=class{constructor(){this.texts=[]}add(t){this.texts.includes(t)||this.texts.push(t)}get told(){let t=this.texts.length-8;return t<=0?this.texts:[...this.texts.slice(0,8),`and ${t} more like these`]}};function Mt(s){if(!(s.size<=2e6))return`The file has ${(s.size/1e6).toFixed(1)} MB; at most ${2e6/1e6} MB are read.`}function Ot(s,t){let e=s.replace(/^\uFEFF/,"").split(/\r\n|\r|\n/).map((l,c)=>({line:l,at:c+1})).filter(({line:l})=>l.trim()&&!l.startsWith("#"));if(e.length<2){t.add("The file has no rows: the first line names the columns, and each line below it is one row.");return}let i=["	",";",","].find(l=>e[0].line.includes(l))??",",n=Ct(e[0].line,i),a=e.slice(1).map(({line:l,at:c})=>({at:c,cells:Ct(l,i)}));a.length>5e3&&t.add(`The file has ${a.length} rows; at most 5000 are read.`);for(let{at:l,cells:c}of a.slice(0,5e3)){let[p,d]=[c.length,n.length];p!==d&&t.add(`Line ${l} has ${p} cells, the header has ${d}.`)}let o=/^#\s*frequency\s*(?:\[hz\])?\s*=\s*(.+)$/im.exec(s),r=o?W(o[1].trim(),"frequency",1,t,{low:1e-9}):void 0;return{header:n,rows:a.slice(0,5e3),frequency:r}}function Ct(s,t){let e=[""],i=!1;for(let n=0;n<s.length;n++){let a=s[n];a==='"'&&i&&s[n+1]==='"'?e[e.length-1]+=s[++n]:a==='"'?i=!i:a===t&&!i?e.push(""):e[e.length-1]+=a}return e.map(n=>n.trim())}var Te=["alpha","alphadeg","aoa","aoadeg","angleofattack","angleofattackdeg","\u03B1"],Ae=["phase","time"];function qt(s){return s.split(/\r\n|\r|\n/,60).some(t=>{let i=t.toLowerCase().replace(/[[(][^\])]*[\])]/g,"").split(/[\t;,]/.test(t)?/[\t;,]/:/\s+/).map(a=>a.replace(/[^a-zα]/g,"")),n=(...a)=>a.some(o=>i.includes(o));return n("cl","liftcoefficient")&&n("cd","dragcoefficient",...Te)&&!n(...Ae)})}function Et(s){let t=/[[(]([^\])]*)[\])]/.exec(s),i=s.replace(/[[(].*$/,"").toLowerCase().trim().split(/[\s_-]+/).filter(Boolean);if(t)return{words:i,unit:t[1].trim().toLowerCase()};for(let[n,a]of Se){let o=i.slice(-n.length);if(i.length>n.length&&n.every((r,l)=>r===o[l]))return{words:i.slice(0,-n.length),unit:a}}return{words:i,unit:""}}var Se=[[["m","s"],"m/s"],[["m/s"],"m/s"],[["km","h"],"km/h"],[["mps"],"m/s"],[["hz"],"hz"],[["w"],"w"],[["mw"],"mw"],[["s"],"s"],[["ms"],"ms"],[["deg"],"deg"],[["degrees"],"deg"],[["rad"],"rad"]];function W(s,t,e,i,{low:n=-1/0,high:a=1/0}={}){if(s===void 0||/^(|na|n\/a|nan|-)$/i.test(s))return;if(/^[+-]?\d+,\d+$/.test(s))return i.add(`Line ${e}, ${t}: \u201C${s}\u201D has a decimal comma; write a decimal point.`),NaN;let o=/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(s)?Number(s):NaN;if(!Number.isFinite(o))return i.add(`Line ${e}, ${t}: \u201C${s.slice(0,40)}\u201D is no number.`),NaN;if(o<n||o>a){let r=a===1/0?`at least ${n}`:`from ${n} to ${a}`;return i.add(`Line ${e}, ${t}: ${s} must be ${r}.`),NaN}return o}var Ce=["speed","airspeed","velocity","v","u"],Pt=["power","p"],Me=["metabolic","metab","met","input","respirometry","aerobic","chemical"],Lt=["frequency","freq","f","beats"],Oe=["error","err","sd","se","sem","std","uncertainty"],qe=["label","name","animal","individual","species","source"],Ee={speed:["m/s","ms-1","m s-1"],power:["w"],frequency:["hz","1/s","s-1"]},Pe={speed:"m/s",power:"W",frequency:"Hz"},lt=(s,t)=>t.includes(s.at(-1));function Nt(s){let t=s.map((a,o)=>({text:a,place:o,...Et(a)})),e=a=>a.words.some(o=>Oe.includes(o)),i=t.find(a=>lt(a.words,Ce)&&!e(a));if(i)return{kind:"flights",columns:Le(t,i,e)};let n=t.find(a=>["phase","time","t"].includes(a.words[0])&&a.words.length===1);return n?{kind:"motion",clock:n,columns:t.filter(a=>a!==n)}:{kind:void 0}}function Le(s,t,e){let i={speed:t},n=a=>a.words.some(o=>Me.includes(o));i.metabolic=s.find(a=>n(a)&&!e(a)),i.power=s.find(a=>lt(a.words,Pt)&&!n(a)&&!e(a)),i.frequency=s.find(a=>lt(a.words,Lt)&&!e(a));for(let a of s.filter(o=>e(o)&&!n(o))){let o=a.words.some(r=>Lt.includes(r))?"frequency":a.words.some(r=>Pt.includes(r))||i.power?"power":"frequency";i[`${o}Error`]??=a}return i.label=s.find(a=>a.words.some(o=>qe.includes(o))),i}function zt({rows:s},t,e){for(let[a,o]of Object.entries(Ee))for(let r of[t[a],t[`${a}Error`]])r?.unit&&!o.includes(r.unit)&&e.add(`Column \u201C${r.text}\u201D is in ${r.unit}; convert it to ${Pe[a]}.`);t.metabolic&&!t.power&&!t.frequency?e.add(`Column \u201C${t.metabolic.text}\u201D is metabolic power; the curve shows mechanical power. wingbeat curve --data compares both.`):!t.power&&!t.frequency&&e.add("No column is named power or frequency; at least one of them must stand beside the speed.");let i={speed:{low:0,high:200}},n=[];for(let{at:a,cells:o}of s){let r={label:o[t.label?.place]??""};for(let l of["speed","power","frequency","powerError","frequencyError"]){let c=t[l];c&&(r[l]=W(o[c.place],c.text,a,e,i[l]??{low:0}))}r.speed===void 0&&e.add(`Line ${a} has no speed.`),(r.power!==void 0||r.frequency!==void 0)&&n.push(r)}return!n.length&&!e.texts.length&&e.add("No row has a speed with a power or a frequency."),n}function It(s,t,e,i){let{rows:n}=s;n.length<3&&i.add("A wingbeat needs at least three rows.");let a=Ne(s,t,i),o=a.map((l,c)=>c).sort((l,c)=>a[l]-a[c]),r=o.map(l=>a[l]);return e.map(l=>Fe(l,o.map(c=>n[c]),r,i))}function Ne({rows:s,frequency:t},e,i){let n=e.words[0]!=="phase",a=["","s","ms"].includes(e.unit);n&&!a&&i.add(`Column \u201C${e.text}\u201D must be in s or ms.`);let o=n?{}:{low:0,high:1},r=s.map(({at:d,cells:f})=>{let u=W(f[e.place],e.text,d,i,o);return u===void 0&&i.add(`Line ${d} has no ${n?"time":"phase"}.`),u});if(!n)return r;let[l,c]=[r[0],r.at(-1)];if(!t)return c>l||i.add(`Column \u201C${e.text}\u201D: the last time must be later than the first.`),r.map(d=>(d-l)/(c-l));let p=t*(e.unit==="ms"?.001:1);return r.map(d=>((d-l)*p%1+1)%1)}var ze={pitch:"wing_pitch",span_fraction:"span_ratio"},Ie=["","-","1","rad","rad/s","m","m/s","n","w","s","hz"],Re=["flap","pitch","twist","fold","sweep","alpha"];function Fe({text:s,words:t,unit:e,place:i},n,a,o){let r=t.some(f=>Re.includes(f))&&!t.includes("rate"),l=["deg","degrees","\xB0","deg/s"].includes(e);!l&&!Ie.includes(e)?o.add(`Column \u201C${s}\u201D is in ${e}; convert it to SI units.`):r&&!l&&e!=="rad"&&o.add(`Column \u201C${s}\u201D is an angle: name its unit, as in \u201C${t.join("_")}_deg\u201D.`);let c=l?Math.PI/180:1,p=n.map(({at:f,cells:u})=>{let b=W(u[i],s,f,o);return c*(b??NaN)}),d=t.join("_");return{name:ze[d]??d,title:s,phase:a,values:p}}var Be="A CSV file of measured flights has the columns speed [m/s] and mechanical power [W] or frequency [Hz], and may have error and label. A CSV file of a wingbeat has phase or time [s], and columns such as flap_deg or pitch_deg. With time, the rows are one beat from the first to the last, unless a line \u201C# frequency [Hz] = 8.2\u201D says how long a beat is. A polar has alpha, CL and CD; those of XFOIL, XFLR5, AeroDyn and others are read as they are.",We="The first line must name the columns: speed with power or frequency, for measured flights; phase or time with flap_deg and others, for a wingbeat; or alpha, CL and CD, for a polar.",_e="Drop a file anywhere on this page, or choose one. A CSV file of flights or a wingbeat stays in your browser: nothing of it is uploaded.",je=/\.(dat|pol|plr|polar|drg|lft)$/i,Rt=s=>/\s/.test(s)?`"${s}"`:s,Q=class{constructor(t){this.face=t,this.shown=[];let e={type:"file",multiple:!0,accept:".csv,.txt,.tsv,.toml,.dat,.pol,.plr,.polar,.drg,.lft"};this.input=h("input",{...e,onchange:()=>this.chosen()});let i=h("label",{class:"wbx-file"},h("span",{},"Choose a file"),this.input);this.list=h("ul",{class:"wbx-own-list"}),this.state=h("div",{class:"wbx-own-state",role:"status"}),this.element=h("section",{class:"wbx-own-data"},h("h2",{},"Your own data"),h("p",{},_e),i,this.list,this.state,h("details",{class:"wbx-more"},h("summary",{},"What the file must hold"),h("p",{},Be))),this.listen()}listen(){let t=new AbortController,e=o=>o.dataTransfer?.types.includes("Files"),{signal:i}=t,n=(o,r)=>document.addEventListener(o,l=>e(l)&&r(l),{signal:i}),a=o=>this.face.root.classList.toggle("wbx-dropping",o);n("dragover",o=>{o.preventDefault(),a(!0)}),n("dragleave",o=>o.relatedTarget===null&&a(!1)),n("drop",o=>{o.preventDefault(),a(!1),this.take([...o.dataTransfer.files])}),this.destroy=()=>t.abort()}chosen(){this.take([...this.input.files]),this.input.value=""}async take(t){this.state.replaceChildren(),this.sent={};for(let e of t)await this.read(e)}async read(t){if(!/\.(csv|tsv|txt)$/i.test(t.name))return this.other(t);let e=new X,i=Mt(t),n=i?"":await t.text();if(qt(n))return this.other(t,!0);i?e.add(i):this.interpret(t.name,n,e),e.texts.length&&this.refuse(t.name,e.told)}interpret(t,e,i){let n=Ot(e,i);if(!n)return;let{kind:a,clock:o,columns:r}=Nt(n.header);if(a==="flights"){let l=r.metabolic&&`; not drawn, because the curve shows mechanical power: ${r.metabolic.text}`;this.add({title:t,kind:a,points:zt(n,r,i),left:l??""},i)}else a==="motion"?this.add({title:t,kind:a,curves:It(n,o,r,i)},i):i.add(We)}other(t,e=je.test(t.name)){if(this.face.onfile)return this.send(t,e?"polar":"species file");if(e)return this.fly(t.name);if(!/\.toml$/i.test(t.name))return this.refuse(t.name,["Its name must end in .csv, in .toml for a species file, or in .pol or .dat for a polar."]);let i=`wingbeat explore --static my-explorer --animals ${Rt(t.name)}`,n=`${t.name} is a species file. Its flights must be solved, which this page cannot do.`;this.say(h("p",{},`${n} This command makes a page with them:`),h("code",{},i))}send(t,e){let i=this.sent[e];return i?this.refuse(t.name,[`${i} is read, and a flight has one ${e}. Drop this one alone.`]):(this.sent[e]=t.name,this.face.onfile(t))}fly(t){let{species:e,speed:i}=this.face.answer??{species:"pigeon",speed:10},n=`${t} is a polar. Flights with it must be solved, which this page cannot do.`,a=`wingbeat orbit ${e} --speed ${i} --aero ${Rt(t)}`;this.say(h("p",{},`${n} This command flies it:`),h("code",{},a))}refuse(t,e){this.say(h("p",{},`${t} is not shown:`),h("ul",{},...e.map(i=>h("li",{},i))))}say(...t){this.state.append(...t),this.state.scrollIntoView({block:"nearest"})}add(t,e){e.texts.length||(this.shown=[...this.shown.filter(({title:i})=>i!==t.title),t],this.show(),t.points&&this.face.curve.element.scrollIntoView({block:"nearest"}))}remove(t){this.shown=this.shown.filter(e=>e!==t),this.show(),this.input.focus()}show(){let t=this.shown.filter(({kind:e})=>e==="flights");this.face.curve.showOwn(t),this.overlay(),this.list.replaceChildren(...this.shown.map(e=>this.row(e,t.indexOf(e))))}overlay(){let{viewer:t}=this.face,e=this.shown.flatMap(({title:i,curves:n=[]})=>n.map(a=>({...a,file:i})));this.drawn=t?.overlay(e)??[]}row(t,e){let i=e<0?"wbx-own-line":`wbx-own-${e%3}`,n=h("span",{class:`wbx-own-key ${i}`,"aria-hidden":"true"}),a={type:"button","aria-label":`Remove ${t.title}`},o=h("button",{...a,onclick:()=>this.remove(t)},"Remove");return h("li",{},n,h("span",{},this.words(t)),o)}words({title:t,points:e,curves:i,left:n}){let{viewer:a,blind:o}=this.face,{axis:r}=this.face.curve;if(e&&r.name!==v.name)return`${t}: not drawn, because this curve shows the ${r.label}, not the speed`;if(e)return`${t}: ${e.length} ${e.length===1?"point":"points"} behind the curve${n}`;if(!a)return`${t}: ${o?"not drawn, because the page has no picture":"drawn with the first picture"}`;let[l,c]=[!0,!1].map(d=>i.filter(({name:u})=>this.drawn.includes(u)===d).map(u=>u.title).join(", ")),p=c&&`; not drawn, because the plots have no such series: ${c}`;return l?`${t}: ${l} as dashed lines in the plots${p}`:`${t}${p}`}};var J=class{constructor(t){this.onpin=void 0,this.answer=void 0,this.ghost=!0,this.act=t,this.button=h("button",{type:"button",onclick:()=>this.toggle()}),this.way=h("button",{type:"button",onclick:()=>this.turn()}),this.words=h("p"),this.element=h("div",{class:"wbx-pins"},this.button,this.way,this.words),this.tell()}now(t){this.current=t,this.button.disabled=!t.scene&&!this.answer}toggle(){this.onpin?this.onpin(!this.answer):this.pin(this.answer?void 0:this.current)}pin(t){this.answer=t,this.tell(),this.act()}turn(){this.ghost=!this.ghost,this.tell(),this.act()}tell(){this.button.textContent=this.answer?"Remove the comparison":"Pin this flight to compare",this.way.textContent=this.ghost?"Show side by side":"Show as a ghost",this.way.hidden=this.words.hidden=!this.answer;let t=this.ghost?"shown pale":"farther away in the side view";this.words.textContent=this.answer?`Pinned, ${t}: ${Ft(this.answer)}.`:""}scene(t){if(!this.answer?.scene)return t.scene;let[e,i]=[t,this.answer].map(n=>({...n.scene.flights[0],label:Ft(n)}));return{...t.scene,flights:[e,i]}}};function Ft(s){return`${s.title} ${bt(s)}, model: ${s.model_title}`}var Bt=`.wbx-row {
  display: flex;
  align-items: center;
  justify-content: space-between;
  gap: 8px 16px;
}
.wbx-pair {
  display: flex;
  gap: 6px;
}
.wbx-chart {
  display: block;
  width: 100%;
  height: 210px;
  touch-action: pan-y;
  cursor: ew-resize;
  user-select: none;
}
.wbx-chart text {
  fill: var(--soft);
  font-size: 12px;
}
.wbx-chart .wbx-tag {
  fill: var(--accent);
  font-size: 14px;
  font-weight: 650;
  paint-order: stroke;
  stroke: var(--paper);
  stroke-width: 4px;
}
.wbx-grid {
  stroke: var(--line);
  stroke-width: 1;
}
.wbx-axis {
  stroke: var(--soft);
  stroke-width: 1;
}
.wbx-curve {
  stroke: var(--ink);
  stroke-width: 2.5;
  stroke-linecap: round;
}
.wbx-dashed {
  stroke-dasharray: 2 6;
}
.wbx-dot {
  fill: var(--ink);
  stroke: var(--ink);
  stroke-width: 2;
}
.wbx-hollow {
  fill: var(--paper);
}
.wbx-pending {
  fill: var(--paper);
  stroke: var(--soft);
  stroke-width: 1.5;
  stroke-dasharray: 2 2;
}
.wbx-gap {
  stroke: var(--bad);
  stroke-width: 2;
  stroke-linecap: round;
}
.wbx-measured rect {
  fill: var(--animals);
  fill-opacity: 0.28;
  stroke: var(--animals);
  stroke-opacity: 0.7;
}
.wbx-law rect,
.wbx-estimated rect {
  fill-opacity: 0.1;
  stroke-dasharray: 3 4;
}
.wbx-measured:hover rect,
.wbx-measured:focus-visible rect {
  fill-opacity: 0.5;
}
.wbx-pin {
  fill: none;
  stroke: var(--accent);
  stroke-width: 2;
}
.wbx-guide {
  stroke: var(--accent);
  stroke-width: 1.5;
}
.wbx-knob {
  fill: var(--accent);
  stroke: var(--paper);
  stroke-width: 3;
}
.wbx-handle:focus-visible {
  outline: none;
}
.wbx-handle:focus-visible .wbx-knob {
  stroke: var(--ink);
}
.wbx-note {
  color: var(--soft);
  font-size: 12.5px;
  min-height: 1.45em;
}
/* Before the first answer there is nothing to drag or to judge. */
.wbx:not([data-status]) :is(.wbx-curve-box, .wbx-judged) {
  visibility: hidden;
}
@media (max-width: 599px) {
  .wbx-row h2 {
    font-size: 13px;
  }
}
`;var Wt=`.wbx-say {
  display: flex;
  flex-direction: column;
  gap: 12px;
}
.wbx-sentence {
  font-size: clamp(20px, 2.05vw, 30px);
  font-weight: 500;
  line-height: 1.22;
  letter-spacing: -0.012em;
  text-wrap: balance;
  min-height: 2.44em;
}
.wbx[data-status]:not([data-status="converged"]) .wbx-sentence {
  min-height: 0;
}
.wbx-sentence b {
  font-weight: 650;
  color: var(--accent);
  font-variant-numeric: tabular-nums;
  white-space: nowrap;
}
.wbx-choices {
  display: flex;
  gap: 8px 20px;
}
.wbx-choice {
  display: inline-flex;
  align-items: center;
  gap: 8px;
  min-width: 0;
}
.wbx-choice label {
  color: var(--soft);
}
.wbx-choice select {
  min-width: 0;
  text-overflow: ellipsis;
  font-weight: 600;
}
.wbx-lights {
  display: flex;
  flex-direction: column;
  gap: 8px;
}
.wbx-light {
  display: flex;
  gap: 10px;
  line-height: 1.35;
}
.wbx-sign {
  flex: none;
  width: 22px;
  height: 22px;
  border-radius: 50%;
  color: var(--paper);
  background: var(--good);
  font-weight: 700;
  text-align: center;
  line-height: 22px;
}
.wbx-bad .wbx-sign {
  background: var(--bad);
  border-radius: 5px;
}
.wbx-open .wbx-sign {
  color: var(--ink);
  background: none;
  border: 2px dashed var(--soft);
  line-height: 18px;
}
.wbx-why,
.wbx-warnings {
  color: var(--soft);
  font-size: 13px;
}
.wbx-warnings {
  margin-top: 8px;
}
.wbx-warnings ul {
  max-height: 6lh; /* whole lines: half a line looks like a fault */
  overflow: auto;
  scrollbar-gutter: stable;
  padding-left: 1.1em;
  list-style: disc;
}
.wbx-picture {
  position: relative;
}
.wbx .wb-viewer {
  padding: 0;
  gap: 6px;
}
.wbx .wb-picture {
  aspect-ratio: auto;
  height: clamp(250px, calc(100vh - 500px - var(--wbx-above, 0px)), 680px);
  min-height: 0;
  max-height: none;
  border: 0;
  border-radius: 14px;
  background: var(--shade);
}
.wbx .wb-warning {
  padding: 2px 10px;
  border-radius: 20px;
  color: var(--paper);
  background: var(--bad);
  font-size: 13px;
}
.wbx .wbx-between {
  background: var(--soft);
}
.wbx-state:empty {
  display: none;
}
.wbx-push {
  align-self: start;
}
/* Beside the folded views, where both have room, so that the curve begins higher. */
@media (min-width: 600px) {
  .wbx-picture:has(.wb-folded:not([open])) + .wbx-push {
    position: relative;
    align-self: end;
    margin-top: -36px;
  }
}
@media (min-width: 600px) {
  .wbx-narrow {
    display: none;
  }
}
@media (max-width: 599px) {
  .wbx-choice label,
  .wbx .wb-player label {
    position: absolute;
    clip-path: inset(50%);
  }
  .wbx-choices {
    display: grid;
    grid-template-columns: repeat(2, minmax(0, 1fr));
    gap: 8px;
  }
  .wbx-choice select {
    width: 100%;
  }
  .wbx-sentence {
    font-size: 19px;
    min-height: 4.88em;
  }
  .wbx-lights {
    flex-direction: row;
    flex-wrap: wrap;
    gap: 6px 16px;
  }
  .wbx .wb-picture {
    height: min(300px, 42vh);
  }
  .wbx .wb-player {
    flex-wrap: nowrap;
    gap: 10px;
  }
  .wbx .wb-readout {
    display: none;
  }
  .wbx-why {
    display: none;
  }
}
`;var _t=`.wbx-judged {
  display: flex;
  flex-direction: column;
  gap: 12px;
  min-width: 0;
}
.wbx-gauges {
  display: flex;
  flex-direction: column;
  gap: 12px;
}
.wbx-gauges summary {
  display: grid;
  grid-template-columns: 1fr auto;
  gap: 1px 10px;
  list-style: none;
}
.wbx-gauges summary::-webkit-details-marker {
  display: none;
}
.wbx-gauges p {
  margin-top: 4px;
  color: var(--soft);
  font-size: 12.5px;
  overflow-wrap: anywhere;
}
.wbx-label {
  color: var(--soft);
}
.wbx-value {
  grid-column: 1;
  grid-row: 2;
  font-size: 21px;
  font-weight: 600;
  line-height: 1.2;
  font-variant-numeric: tabular-nums;
}
.wbx-word {
  grid-column: 2;
  grid-row: 2;
  align-self: end;
  color: var(--soft);
}
.wbx-inside .wbx-word {
  color: var(--good);
}
.wbx-outside .wbx-word {
  color: var(--bad);
  font-weight: 600;
}
.wbx-bar {
  grid-column: 1 / -1;
  position: relative;
  height: 10px;
  margin: 5px 0 3px;
  border-radius: 5px;
  background: var(--shade);
}
.wbx-band {
  position: absolute;
  inset: 0;
  border-radius: 5px;
  background: var(--band);
}
.wbx-mark {
  position: absolute;
  top: -4px;
  width: 4px;
  height: 18px;
  margin-left: -2px;
  border-radius: 2px;
  background: var(--ink);
}
.wbx-outside .wbx-mark {
  background: var(--bad);
}
.wbx-beyond {
  width: 0;
  height: 0;
  margin-left: -6px;
  border: 9px solid transparent;
  border-left: 11px solid var(--bad);
  border-right: 0;
  border-radius: 0;
  background: none;
}
.wbx-outside .wbx-beyond {
  background: none;
}
.wbx-mark.wbx-was {
  width: 8px;
  margin-left: -4px;
  border: 2px solid var(--accent);
  background: none;
}
.wbx-pins {
  display: flex;
  flex-wrap: wrap;
  gap: 8px;
}
.wbx-pins p {
  flex: 1 1 100%;
  color: var(--soft);
  font-size: 13px;
}
.wbx-more {
  font-size: 13px;
}
.wbx-more summary {
  color: var(--soft);
}
.wbx-more table {
  border-collapse: collapse;
  margin-top: 6px;
}
.wbx-more th {
  text-align: left;
  font-weight: 400;
  padding: 2px 10px 2px 0;
}
.wbx-more td {
  padding: 2px 8px 2px 0;
  text-align: right;
  font-variant-numeric: tabular-nums;
}
.wbx-more td:last-child {
  text-align: left;
}
@media (max-width: 899px) {
  .wbx-judged {
    order: 1;
  }
}
`;var jt=`.wbx-own-data {
  display: flex;
  flex-direction: column;
  align-items: start;
  gap: 8px;
  color: var(--soft);
  font-size: 13px;
}
.wbx-own-data h2 {
  color: var(--ink);
}
.wbx-file {
  position: relative;
  padding: 5px 12px;
  color: var(--ink);
  background: var(--shade);
  border: 1px dashed var(--soft);
  border-radius: 8px;
  font-size: 15px;
}
.wbx-file input {
  position: absolute;
  inset: 0;
  width: 100%;
  opacity: 0;
  cursor: pointer;
}
.wbx-file:hover,
.wbx-dropping .wbx-file {
  border-color: var(--accent);
}
.wbx-file:focus-within {
  outline: 2px solid var(--accent);
  outline-offset: 2px;
}
.wbx-dropping {
  outline: 3px dashed var(--accent);
  outline-offset: -6px;
}
.wbx-own-list li {
  display: flex;
  align-items: center;
  gap: 10px;
  padding: 2px 0;
  color: var(--ink);
}
.wbx-own-key {
  flex: none;
  width: 11px;
  height: 11px;
  transform: rotate(45deg) scale(0.8);
  background: var(--own);
}
.wbx-own-key.wbx-own-line {
  width: 20px;
  height: 0;
  transform: none;
  background: none;
  border-top: 2.5px dashed var(--own);
}
.wbx-own-state:empty {
  display: none;
}
.wbx-own-state {
  color: var(--ink);
}
.wbx-own-state ul {
  padding-left: 1.2em;
  list-style: disc;
}
.wbx-own-state code {
  display: block;
  margin-top: 4px;
  padding: 6px 10px;
  border-radius: 6px;
  background: var(--shade);
  overflow-wrap: anywhere;
}
.wbx {
  --own: light-dark(#7a2e8f, #d9a3ea);
}
.wbx-own-1 {
  --own: light-dark(#0a6b6b, #6fd0cb);
}
.wbx-own-2 {
  --own: light-dark(#a02a55, #ff9fbf);
}
.wbx-own path {
  stroke: var(--own);
  stroke-width: 1.5;
  fill: none;
}
.wbx-own .wbx-own-mark {
  fill: var(--own);
  fill-opacity: 0.35;
}
`;var Dt=`.wbx {
  color-scheme: light dark;
  --ink: light-dark(#1c2128, #e9ecf1);
  --paper: light-dark(#ffffff, #14181d);
  --soft: light-dark(#57606c, #a4adb8);
  --line: light-dark(#d9dde3, #343c46);
  --shade: light-dark(#f0f2f5, #1f252c);
  --accent: light-dark(#0b5cad, #6db3f2);
  --good: light-dark(#176639, #7fd6a0);
  --bad: light-dark(#a3261b, #ff9c91);
  --band: light-dark(#bfe3cd, #23523a);
  --animals: light-dark(#8a5300, #f0bd62);
  color: var(--ink);
  background: var(--paper);
  font: 15px/1.45 system-ui, sans-serif;
  display: grid;
  grid-template-columns: minmax(0, 1fr) 320px;
  grid-template-rows: auto 1fr;
  gap: 12px 28px;
  padding: 20px 24px 24px;
}
.wbx[data-theme="light"] {
  color-scheme: light;
}
.wbx[data-theme="dark"] {
  color-scheme: dark;
}
.wbx *,
.wbx *::before {
  box-sizing: border-box;
}
.wbx [hidden] {
  display: none;
}
.wbx :focus-visible {
  outline: 2px solid var(--accent);
  outline-offset: 2px;
}
.wbx h1,
.wbx h2,
.wbx p,
.wbx ul {
  margin: 0;
  padding: 0;
}
.wbx ul {
  list-style: none;
}
.wbx h2 {
  font-size: 15px;
  font-weight: 600;
}
.wbx button,
.wbx select {
  font: inherit;
  color: var(--ink);
  background: var(--shade);
  border: 1px solid var(--line);
  border-radius: 8px;
  min-height: 34px;
  padding: 3px 12px;
  cursor: pointer;
}
.wbx button:disabled {
  color: var(--soft);
  cursor: default;
}
.wbx button:hover,
.wbx select:hover {
  border-color: var(--accent);
}
.wbx button[aria-pressed="true"] {
  color: var(--accent);
  border-color: var(--accent);
}
.wbx summary {
  cursor: pointer;
}
.wbx-unseen {
  position: absolute;
  width: 1px;
  height: 1px;
  overflow: hidden;
  clip-path: inset(50%);
}
.wbx-stage {
  display: flex;
  flex-direction: column;
  gap: 10px;
  min-width: 0;
}
.wbx-side {
  grid-column: 2;
  grid-row: 1 / 3;
}
.wbx-extras {
  grid-column: 1 / -1;
  display: grid;
  grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
  gap: 24px 48px;
  padding-top: 18px;
  border-top: 1px solid var(--line);
}
@media (min-width: 900px) {
  .wbx-side {
    display: flex;
    flex-direction: column;
    gap: 18px;
    min-width: 0;
    border-left: 1px solid var(--line);
    padding-left: 24px;
    margin-left: -4px;
  }
}
@media (max-width: 899px) {
  .wbx {
    display: flex;
    flex-direction: column;
    padding: 12px 14px 20px;
  }
  .wbx-side {
    display: contents;
  }
  .wbx-extras {
    order: 9;
    grid-template-columns: minmax(0, 1fr);
  }
}
`;var Ut=`.wbx-tours ul {
  display: grid;
  grid-template-columns: repeat(auto-fill, minmax(230px, 1fr));
  gap: 14px 20px;
  margin-top: 10px;
}
.wbx-tours li {
  display: flex;
  flex-direction: column;
  align-items: start;
  gap: 4px;
  color: var(--soft);
  font-size: 13px;
}
.wbx-tours button {
  font-weight: 600;
  font-size: 15px;
}
.wbx-tour {
  position: fixed;
  z-index: 10;
  right: 24px;
  bottom: 24px;
  width: 348px;
  display: flex;
  flex-direction: column;
  gap: 8px;
  padding: 12px 18px 16px;
  color: var(--ink);
  background: var(--paper);
  border: 1px solid var(--line);
  border-top: 4px solid var(--accent);
  border-radius: 12px;
  box-shadow: 0 8px 30px rgb(0 0 0 / 0.24);
}
.wbx-tour h2 {
  font-size: 19px;
  line-height: 1.25;
}
.wbx-tour h2:focus-visible {
  outline: none;
}
.wbx-hint {
  color: var(--soft);
  font-size: 12.5px;
}
.wbx-tour-text {
  display: flex;
  flex-direction: column;
  gap: 7px;
}
.wbx-tour-text b {
  color: var(--accent);
  font-weight: 650;
  font-variant-numeric: tabular-nums;
}
.wbx-tour-text code {
  padding: 2px 5px;
  font-size: 12px;
  border-radius: 5px;
  background: var(--shade);
  overflow-wrap: anywhere;
  box-decoration-break: clone;
}
.wbx-tour .wbx-row > :last-child {
  margin-left: auto;
}
.wbx-tour button:disabled,
.wbx-tours button:disabled {
  opacity: 0.45;
  cursor: default;
}
.wbx-tour .wbx-close {
  padding: 0 10px;
  font-size: 18px;
  line-height: 1;
}
.wbx-tour [data-go="next"] {
  color: var(--paper);
  background: var(--accent);
  border-color: var(--accent);
  font-weight: 600;
}
.wbx [data-part],
.wbx-own-state,
.wbx .wb-picture {
  scroll-margin: 12px;
}
.wbx[data-tour] {
  padding-bottom: 300px;
}
.wbx[data-look="curve"] [data-part="curve"],
.wbx[data-look="gauges"] .wbx-gauges {
  outline: 2px solid var(--accent);
  outline-offset: 8px;
  border-radius: 6px;
}
@media (max-width: 599px) {
  .wbx-tour {
    inset: auto 0 0;
    width: auto;
    max-height: 46vh;
    overflow: auto;
    padding: 8px 14px 12px;
    border-radius: 14px 14px 0 0;
  }
  .wbx-tour h2 {
    font-size: 17px;
  }
  .wbx[data-tour] [data-part],
  .wbx[data-tour] .wb-picture {
    scroll-margin-bottom: 48vh;
  }
  .wbx[data-tour] {
    padding-bottom: 50vh;
  }
}
`;var Ht=Dt+Wt+Bt+_t+jt+Ut;var $=s=>`${x(s)} W`,S=s=>s.speed?`at ${x(s.speed)} m/s`:"in hover",N=s=>`${x(s)} deg`,Vt=s=>`${x(100*s,2)} %`;function z(s,t){let e=s.numbers.find(([i])=>i===t);return e&&[e[1],e[2]].filter(Boolean).join(" ")}var O=(s,t)=>parseFloat(z(s,t)),_=s=>y(s[s.axis.name],s.axis.unit);function j(s,t){return s.gauges.find(e=>e.name===t&&e.value!==null)}var k=(s,t)=>s?[t(s)]:[];function T(s,t,e=$){let[i,n]=[e(s),e(t)];return i===n?`stays at ${n}`:`${t>s?"rises":"falls"} from ${i} to ${n}`}function Gt({spent:s},t){let e=Object.values(s).reduce((i,n)=>i+n,0);return s[t]/e}var Ye=/(\d[\d.]*(?:e[+-]?\d+)? (?:m\/s|N m\/rad|W\/kg|W|Hz|%|deg|g|m|beats?)(?![\w/]))/;function Kt(s){let t=e=>e.split(Ye).map((i,n)=>n%2?h("b",{},i):i);return s.split(/`([^`]*)`/).flatMap((e,i)=>i%2?[h("code",{},e)]:t(e))}var Xe={profile:"profile power, the drag of the wings",induced:"induced power itself",parasite:"the drag of body and tail",unsteady:"that of rotation and added mass"};function Yt({spent:s}){let[t,e]=Object.entries(s).reduce((i,n)=>n[1]>i[1]?n:i);return`${Xe[t]}, with ${$(e)}`}function Xt({value:s,low:t,high:e,unit:i,inside:n}){let a=r=>[x(r),i].filter(Boolean).join(" ");if(n===null)return`${a(s)}; no plausible range is known`;if(n)return`${a(s)}, inside the plausible range`;let o=s>e?`at most ${a(e)}`:`at least ${a(t)}`;return`${a(s)}; plausible is ${o}`}var Qe={upward:"from below",downward:"from above",head:"from ahead",tail:"from behind"};function Z({direction:s,size:t}){return`a gust ${Qe[s]} of up to ${x(t)} m/s`}var q=s=>`${x(s)} Hz`,Qt=s=>`${x(s)} m`;function Jt(s){let t=j(s,"flap_amplitude");return t?[`The wings flap ${x(t.value)} ${t.unit} to either side of their mean.`]:[]}function Zt(s,t){return s>=t?"has enough for that":`would lack ${$(t-s)}`}function te(s){let t=z(s,"a small disturbance");return t==="decays"?["A small disturbance decays."]:t==="grows"?["But a small disturbance grows, as long as the wingbeat does not react."]:[]}function ee(s,{name:t,unit:e}){let i=[];if(s.forEach((r,l)=>{r.stable&&s[l-1]?.stable?i.at(-1).push(r[t]):r.stable&&i.push([r[t]])}),!i.length)return["In none of the flights computed here does a small disturbance decay."];let n=i.map(([r,...l])=>l.length?`from ${x(r)} to ${y(l.at(-1),e)}`:`at ${y(r,e)}`),a=s.filter(({stable:r})=>r===!1).length,o=a?` In the other ${a} it grows, as long as the wingbeat does not react.`:"";return[`A small disturbance decays ${n.join(" and ")}.${o}`]}function se({axis:s,species:t,speed:e,...i}){let n=O(i,"damping of the pitch hinges"),a=`${s.name}=${i[s.name]} pitch_hinge.damping=${n}`;return`wingbeat orbit ${t} --model ${i.model} --speed ${e} --set ${a}`}var I={animal:"robofalcon2",model:"animal",along:"pitch_hinge.stiffness"},tt="amplitude of the wing's pitch",et="lead of the wing's pitch over its flap",ie={name:"hinges",title:"Which spring for the wing?",teaser:"No motor pitches these wings. The slider is the stiffness of their hinges.",steps:[{name:"soft",title:"A soft spring",flight:{...I,at:"first"},view:{camera:"side",arrows:!0},look:"picture",tell:({now:s})=>["A motor flaps these wings. What pitches them are the air and their own inertia, against spring and damper.",`The softest spring computed here has ${_(s)}. The pitch swings by ${N(O(s,tt))} to either side.`,`The flight needs ${$(s.power)}.`]},{name:"cheapest",title:"The spring that costs least",flight:{...I,at:"cheapest"},view:{camera:"side",arrows:!0},pin:"soft",look:"curve",tell:({now:s,seen:t,points:e})=>[`Of the ${e.length} springs computed here, that with ${_(s)} needs the least power, ${$(s.power)}.`,...k(t.soft,i=>`Against the soft spring, the ghost, the swing ${T(O(i,tt),O(s,tt),N)}.`),...k(t.soft,i=>`The frequency ${T(i.frequency,s.frequency,q)}${Je(s)}.`)]},{name:"stiff",title:"Stiffer still",flight:{...I,at:"last"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`With ${_(s)} the pitch swings by ${N(O(s,tt))} to either side.`,...k(t.cheapest,e=>`Against the cheapest spring, power ${T(e.power,s.power)}.`)]},{name:"stable",title:"Does it stay on its course?",flight:{...I,at:"stable"},view:{camera:"oblique",arrows:!1},look:"curve",tell:({now:s,seen:t,points:e})=>[...ee(e,s.axis),...k(z(s,"a small disturbance")==="decays",()=>`Of the stable ones, that with ${_(s)} needs the least power.`),...k(t.cheapest,i=>`Against the cheapest of all, power ${T(i.power,s.power)}.`)]},{name:"wing",title:"What the wing does",flight:{...I,at:"stable"},placeOf:"stable",view:{camera:"side",arrows:!0},look:"picture",tell:({now:s,seen:t})=>[`Watch the wing turn about its axis. Its leading edge is ${Ze(s)} in the downstroke than in the upstroke.`,`The pitch leads the flap by ${N(O(s,et))}. By a quarter of a beat, it would be largest at mid-stroke.`,...k(t.soft,e=>`From the soft spring to this one, the lead ${T(O(e,et),O(s,et),N)}.`)]},{name:"next",title:"Fly your own hinge",flight:{...I,at:"stable"},placeOf:"stable",view:{camera:"side",arrows:!1},look:"curve",tell:({now:s})=>["This command flies the hinge of this step, and saves the flight. Put your own numbers in:",`\`${se(s)} -o gait.nc\``,`With \`--free ${s.axis.name}\` the solver chooses the spring. And this tells what becomes of disturbances:`,"`wingbeat stability gait.nc`"]}]},Je=s=>j(s,"frequency")?.limited?", where a limit holds it":"",Ze=s=>Math.sin(O(s,et)*Math.PI/180)>0?"lower":"higher";var D={animal:"robofalcon2",model:["paper","animal"]},ae={name:"robot",title:"Build a robot",teaser:"From weight and span to a gait, and to what the motor must give.",steps:[{name:"weight",title:"Start from the weight",flight:{...D,at:"cheapest"},view:{camera:"front",arrows:!1},look:"picture",tell:({now:s,semiSpan:t})=>[`This ${s.title} has a mass of ${z(s,"mass")} and two wings of ${Qt(t)} each.`,"Over a beat, the wings must carry the weight and balance the drag.","At the end of the beat the body must have the attitude and the velocities that it began with."]},{name:"gait",title:"Find a gait that closes",flight:{...D,at:"cheapest"},view:{camera:"side",arrows:!0},look:"picture",tell:({now:s})=>[`The solver looks for a wingbeat that repeats itself. It beats at ${q(s.frequency)} ${S(s)}.`,...Jt(s),"Arrows show the air load on each strip of the wing."]},{name:"motor",title:"What the motor must give",flight:{...D,at:"cheapest"},view:{camera:"side",arrows:!0},look:"gauges",tell:({now:s})=>[`The hinges of the wings need ${$(s.power)}: the mean over a beat, braking not counted.`,`That is ${$(s.power/s.mass)} for each kilogram of the robot.`,"Gears and motor lose some of what they draw, so the battery must give more."]},{name:"slow",title:"Slow flight",flight:{...D,at:"first"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`The slowest flight computed here, ${S(s)}, needs ${$(s.power)}.`,...k(t.gait,e=>`Against the cheapest flight the frequency ${T(e.frequency,s.frequency,q)}.`)]},{name:"fast",title:"Fast flight",flight:{...D,at:"last"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`${M(S(s))} it needs ${$(s.power)}.`,...k(t.gait,({power:e})=>`A motor sized for the cheapest flight, with ${$(e)}, ${Zt(e,s.power)}.`),"For a robot of your own, write its numbers into a species file and drop it on this page."]}]},st={animal:"pigeon",model:["paper","animal"],at:"pushed"},ne={direction:"tail",feedback:!1},oe={name:"tumbling",title:"Why it tumbles",teaser:"One gust, first with a fixed wingbeat, then with feedback.",steps:[{name:"orbit",title:"A flight that repeats itself",flight:st,view:{camera:"side",arrows:!1},look:"picture",tell:({now:s})=>[`${M(S(s))} the pigeon flies a beat that ends as it began. Undisturbed, it would go on for ever.`,...te(s)]},{name:"free",title:"A gust, and a wingbeat that does not react",flight:st,view:{camera:"side",arrows:!1},push:ne,look:"picture",tell:({push:s})=>[`The pigeon meets ${Z(s)}. Its wings go on beating as before.`,`It is ${s.outcome}.`]},{name:"held",title:"The same gust, with feedback",flight:st,view:{camera:"side",arrows:!1},push:{...ne,feedback:!0},look:"picture",tell:({push:s})=>[`Again ${Z(s)}. Now feedback sees attitude and velocities once in each beat, and changes the wingbeat.`,`It is ${s.outcome}.`]},{name:"again",title:"Push it yourself",flight:st,view:{camera:"side",arrows:!1},push:{direction:"upward",feedback:!1},look:"picture",tell:({push:s})=>[`Now ${Z(s)}, again without feedback. The pigeon is ${s.outcome}.`,"Below the picture you can choose the gust yourself.","The feedback follows from the equations of motion; how birds do it is not modelled."]}]};var he={name:"hovering",title:"Why hovering costs",teaser:"A hummingbird slows down, and its power rises.",steps:[{name:"cheap",title:"The cheapest flight",flight:{animal:"annas-hummingbird",model:"animal",at:"cheapest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:s})=>[`Of the speeds computed here, this hummingbird needs the least power ${S(s)}: ${$(s.power)}.`,"To stay up it must push air down. The downwash tilts the air loads back, and that costs induced power.",`It is ${$(s.spent.induced)} here, ${Vt(Gt(s,"induced"))} of what is spent on the air.`]},{name:"slow",title:"Slower, with less air to push",flight:{animal:"annas-hummingbird",model:"animal",at:"early"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`${M(S(s))} less air passes the wings in each second, and all of it must go down faster.`,...k(t.cheap,e=>`Induced power ${T(e.spent.induced,s.spent.induced)}.`)]},{name:"hover",title:"No wind but its own",flight:{animal:"annas-hummingbird",model:"animal",at:"first"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`${M(S(s))} the bird beats at ${q(s.frequency)}.`,...s.speed?[]:["What moves the air past its wings is their beat alone."],...k(t.cheap,e=>`Against the cheapest flight, power ${T(e.power,s.power)}.`),`Of what is spent on the air, the largest part is ${Yt(s)}.`]},{name:"fast",title:"Fast flight",flight:{animal:"annas-hummingbird",model:"animal",at:"last"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`${M(S(s))} air is plentiful, but it drags on body and wings.`,...k(t.hover,e=>`Against the slowest flight, induced power ${T(e.spent.induced,s.spent.induced)}.`),...k(t.hover,e=>`The power against the drag of body and tail ${T(e.spent.parasite,s.spent.parasite)}.`)]},{name:"muscle",title:"Can its muscle do it?",flight:{animal:"annas-hummingbird",model:"animal",at:"first"},view:{camera:"front",arrows:!1},look:"gauges",tell:({now:s})=>[`Back ${S(s)}. Power per mass is ${Xt(j(s,"positive_power_per_mass"))}.`,"The bars show where the other numbers lie. Now drag the point yourself."]}]},ct={animal:"bat",model:"paper",at:"cheapest"},re={...ct,model:"dickinson"},le={name:"coefficients",title:"A plate against a fruit fly",teaser:"The same bat in the same air; only the measured wing differs.",steps:[{name:"plate",title:"A bat on flat plates",flight:ct,view:{camera:"oblique",arrows:!0},look:"picture",tell:({now:s})=>["The forces of the air were measured once, on another wing. The model uses them for every strip of this one.","Here it was a flat plate (Su et al. 2023).",`So the bat beats at ${q(s.frequency)} and needs ${$(s.power)} ${S(s)}.`]},{name:"fly",title:"The same bat, a fruit fly's wing",flight:re,placeOf:"plate",view:{camera:"oblique",arrows:!0},pin:"plate",look:"picture",tell:({now:s,seen:t})=>["The coefficients now come from a model of a fruit fly's wing in oil (Dickinson et al. 1999).",...k(t.plate,()=>"Animal and speed are the same; the ghost in the picture flies on plates."),...k(t.plate,e=>`The frequency ${T(e.frequency,s.frequency,q)}.`),...k(t.plate,e=>`Power ${T(e.power,s.power)}.`)]},{name:"fast",title:"Faster, on plates",flight:{...ct,at:"last"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:s,seen:t})=>[`${M(S(s))}, on plates again, the bat needs ${$(s.power)}.`,...k(t.plate,e=>`The frequency ${T(e.frequency,s.frequency,q)}.`)]},{name:"fastFly",title:"Faster, with the fruit fly's wing",flight:{...re,at:"last"},placeOf:"fast",view:{camera:"side",arrows:!0},pin:"fast",look:"curve",tell:({now:s,seen:t})=>[...k(t.fast,e=>`With the fruit fly's coefficients, power ${T(e.power,s.power)} ${S(s)}.`),"Neither wing is a bat's. The two answers show how much a result depends on that choice."]}]};var de=[he,le,ae,ie,oe],pe={first:s=>s[0],last:s=>s.at(-1),cheapest:dt,stable:s=>dt(s.some(ce)?s.filter(ce):s),early:(s,t)=>ts(s,t,.75*s[0][t]+.25*dt(s)[t])},ce=({stable:s})=>s;function dt(s){return s.reduce((t,e)=>e.power<t.power?e:t)}function ts(s,t,e){let i=n=>Math.abs(n[t]-e);return s.reduce((n,a)=>i(a)<i(n)?a:n)}var es=6,it=class{constructor(t){this.face=t,this.calm=window.matchMedia("(prefers-reduced-motion: reduce)").matches,this.cards=de.map(i=>this.card(i));let e=h("ul",{},...this.cards.map(({element:i})=>i));this.element=h("section",{class:"wbx-tours"},h("h2",{},"Guided tours"),e),this.build()}card(t){let e=h("button",{type:"button",onclick:()=>this.start(t,e)},t.title),i=h("span");return{story:t,button:e,words:i,element:h("li",{},e,i)}}offer(){for(let{story:t,button:e,words:i}of this.cards)e.disabled=!t.steps.some(n=>this.flight(n)),i.textContent=e.disabled?"This page has no flight of this tour.":t.teaser}build(){let t=(i,n,a={})=>h("button",{type:"button",onclick:n,...a},i);this.count=h("p",{class:"wbx-hint"}),this.title=h("h2",{tabindex:"-1"}),this.text=h("div",{class:"wbx-tour-text","aria-live":"polite"}),this.back=t("Back",()=>this.go(this.nth-1,-1)),this.again=t("Show this step again",()=>this.go(this.nth,1),{hidden:!0}),this.next=t("Next",()=>this.isLast?this.close():this.go(this.nth+1,1),{"data-go":"next"});let e=t("\xD7",()=>this.close(),{class:"wbx-close","aria-label":"Close the tour"});this.panel=h("section",{class:"wbx-tour","aria-label":"Guided tour",hidden:!0,onkeydown:i=>this.key(i)},h("div",{class:"wbx-row"},this.count,e),this.title,this.text,h("div",{class:"wbx-row"},this.back,this.again,this.next))}key(t){if(t.ctrlKey||t.metaKey||t.altKey)return;let e={ArrowRight:this.next,ArrowLeft:this.back}[t.key];if(t.key==="Escape")this.close();else if(e&&!e.disabled)e.click();else return;t.preventDefault(),t.stopPropagation()}start(t,e){this.before??=this.found(),Object.assign(this,{story:t,opener:e,seen:{}}),this.panel.hidden=!1,this.face.root.dataset.tour=t.name,this.title.focus({preventScroll:!0}),this.go(0,1)}found(){let{viewer:t,pins:e}=this.face;return{view:t&&wt(t),pinned:e.answer,ghost:e.ghost}}close(){let{viewer:t,pins:e}=this.face;this.pin(void 0),e.ghost!==this.before.ghost&&e.turn(),t&&this.before.view&&mt(t,this.before.view),this.before=void 0,this.panel.hidden=!0,this.step=void 0,delete this.face.root.dataset.tour,delete this.face.root.dataset.look,this.opener.focus()}flight({flight:t}){let e=t.at==="pushed",i={animal:t.animal,along:t.along??v.name},n=[t.model].flat().find(a=>this.face.has({...i,model:a,push:e}));return n&&{...i,model:n}}go(t,e){let{steps:i}=this.story,n=[],a=t;for(;i[a]&&!this.flight(i[a]);a+=e)n.push(i[a].title);let o=i.slice(a+1),r=!o.some(l=>this.flight(l));r&&n.push(...o.map(({title:l})=>l)),this.left=n.map(l=>`Left out, because this page has no such flight: \u201C${l}\u201D.`),Object.assign(this,{nth:a,step:i[a],ready:!1,tries:0,isLast:r}),this.count.textContent=`${this.story.title}: ${a+1} of ${i.length}`,this.title.textContent=this.step.title,this.back.disabled=!i.slice(0,a).some(l=>this.flight(l)),this.next.textContent=this.isLast?"Finish":"Next",this.again.hidden=!0,this.say(["Looking for this flight \u2026"]),this.ask()}heard(){this.step&&(this.ready?this.again.hidden=ss(this.face.answer,this.shown):this.ask())}heardCurve(){this.step&&this.waitsForCurve&&!this.face.answer.provisional&&this.ask()}ask(){let{face:t,step:e}=this,{animal:i,along:n,model:a}=this.flight(e),{answer:o}=t;if(!(o?.species===i&&o.model===a&&t.curve.axis.name===n))return this.request({animal:i,along:n,model:a});let{pending:l=[],points:c}=t.curve.data;if(this.waitsForCurve=l.length>0,this.waitsForCurve)return this.say([`Computing the curve; ${l.length} more flights to go.`]);let p=this.place(c.filter(d=>d.certified));if(p!==void 0&&Math.abs(p-o[n])>1e-9)return this.request({at:p});if(e.push&&!o.scene?.pushes&&o.status==="converged")return this.say(["Flying through the gusts \u2026"]),t.onpush();this.arrive(o)}request(t){this.tries+=1,this.tries>es?this.finish(["This page does not have the flight of this step."]):this.face.ask(t)}place(t){let{step:e,seen:i,face:n}=this,{name:a}=n.curve.axis;return e.flight.at==="pushed"?n.pushedAt(n.answer):i[e.placeOf]?i[e.placeOf][a]:t.length?pe[e.flight.at](t,a)[a]:void 0}arrive(t){let{step:e,seen:i}=this;if(this.ready=!0,t.status==="converged"&&(i[e.name]=t),this.pin(i[e.pin]),this.look(),e.push||this.face.viewer?.pushes.reset(),t.status!=="converged")return this.finish([t.sentence]);let n=e.push&&this.push(t.scene.pushes);if(e.push&&!n)return this.finish(["No feedback was found that holds this flight."]);let{points:a}=this.face.curve.data;this.finish(e.tell({now:t,seen:i,points:a,push:n,semiSpan:t.scene.flights[0].semi_span}))}finish(t){this.ready=!0,this.shown=this.face.answer,this.say(t)}say(t){let e=this.left.map(i=>h("p",{class:"wbx-hint"},i));this.text.replaceChildren(...e,...t.map(i=>h("p",{},...Kt(i))))}pin(t){let{pins:e}=this.face,i=this.pinned&&e.answer===this.pinned,n=t??(i?this.before.pinned:e.answer);n!==e.answer&&e.pin(n),this.pinned=t}push(t){let{direction:e,feedback:i}=this.step.push,n=t.find(a=>a.direction===e&&a.feedback===i);return n&&this.face.viewer.pushes.choose(n),n}look(){let{viewer:t,root:e}=this.face;if(!t)return;let{camera:i,arrows:n}=this.step.view,a={resultant:n,lift:!1,drag:!1,trails:!0};t.setCamera(i);for(let r of t.root.querySelectorAll(".wb-toggle")){let l=r.querySelector("input"),c=a[r.textContent.trim()];c!==void 0&&l.checked!==c&&l.click()}e.dataset.look=this.step.look;let o=this.step.look==="picture"?t.picture:e.querySelector(`[data-part="${this.step.look}"]`);this.scroll(e,o)}scroll(t,e){let i=this.calm?"auto":"smooth",n=this.panel.offsetWidth<window.innerWidth?0:this.panel.offsetHeight;e.getBoundingClientRect().bottom-t.getBoundingClientRect().top<=window.innerHeight-n?t.scrollIntoView({block:"start",behavior:i}):e.scrollIntoView({block:"end",behavior:i})}};function ss(s,t){return["species","model","speed",s.axis?.name].every(e=>s[e]===t[e])}var is={closes:["Closes","Does not close"],plausible:["Plausible","Not plausible"]},ns=/(?<![\w.])(\d[\d.,]*(?:e[+-]?\d+)?(?: m\/s| W| times a second| times)?)/,nt=class{constructor(){this.sentence=h("h1",{class:"wbx-sentence"}),this.lights=h("ul",{class:"wbx-lights","aria-label":"Verdict"}),this.summary=h("summary"),this.list=h("ul",{tabindex:"0","aria-label":"Warnings"}),this.warnings=h("details",{class:"wbx-warnings"},this.summary,this.list),this.warnings.open=window.matchMedia("(min-width: 900px)").matches,this.warnings.hidden=!0,this.element=h("div",{class:"wbx-verdict"},this.lights,this.warnings),this.spoken=h("p",{class:"wbx-unseen",role:"status"})}show(t){let e=t.sentence.split(ns);this.sentence.replaceChildren(...e.map((o,r)=>r%2?h("b",{},o):o)),this.speak(t.sentence),this.lights.replaceChildren(...t.lights.map(o=>this.light(o)));let{warnings:i}=t;this.warnings.hidden=!1,this.warnings.classList.toggle("wbx-narrow",!i.length),t.status!=="converged"&&(this.warnings.open=!0);let n=i.length===1?"1 warning":`${i.length} warnings`;this.summary.replaceChildren(h("span",{class:"wbx-narrow"},"Reasons, "),n);let a=t.lights.map(({text:o})=>h("li",{class:"wbx-narrow"},o));this.list.replaceChildren(...a,...i.map(o=>h("li",{},o)))}speak(t){clearTimeout(this.later),this.later=setTimeout(()=>this.spoken.textContent=t,700)}light({name:t,good:e,known:i,text:n}){let a=e?"good":i===!1?"open":"bad",o=a==="open"?"Plausible? Not known":is[t][e?0:1],r=h("span",{class:"wbx-sign","aria-hidden":"true"},{good:"\u2713",bad:"!",open:"?"}[a]),l=h("span",{},h("strong",{},o)," ",h("span",{class:"wbx-why"},n));return h("li",{class:`wbx-light wbx-${a}`,"data-light":t},r,l)}};var as="the closest wingbeat: it does not fly",os=0,R=class{constructor(t,{theme:e="system",snap:i=!0}={}){this.onask=()=>{},this.onpush=void 0,this.onfile=void 0,this.onpushed=()=>{},this.theme=e,this.id=`wbx${++os}`,this.verdict=new nt,this.curve=new G(n=>this.ask({at:n}),i),this.gauges=new K,this.pins=new J(()=>this.show()),this.tour=new it(this),this.linked=new Y(this),this.own=new Q(this),this.root=h("section",{class:"wbx","aria-label":"Explorer"},h("style",{},Ht)),this.root.face=this,this.build(),this.setTheme(e),t.append(this.root)}build(){this.animal=this.choice("Animal",o=>this.ask({animal:o})),this.along=this.choice("Slider",o=>this.ask({along:o,at:void 0})),this.model=this.choice("Model",o=>this.ask({model:o}));let t=[this.animal,this.model,this.along].map(({element:o})=>o);this.choices=h("div",{class:"wbx-choices"},...t),this.state=h("p",{class:"wbx-state",role:"status"}),this.picture=h("div",{class:"wbx-picture"}),this.pushButton=h("button",{type:"button",class:"wbx-push",hidden:!0,onclick:()=>this.push()}),this.numbers=h("tbody");let e=h("table",{},this.numbers),i=h("details",{class:"wbx-more"},h("summary",{},"More numbers"),e),n=[h("h2",{},"Is this flight plausible?"),this.gauges.element,this.pins.element,i],a=h("div",{class:"wbx-judged","data-part":"gauges"},...n);this.root.append(h("header",{class:"wbx-say"},this.choices,this.verdict.sentence,this.verdict.spoken),h("div",{class:"wbx-side"},this.verdict.element,a),h("div",{class:"wbx-stage"},this.picture,this.pushButton,this.state,this.curve.element),h("div",{class:"wbx-extras"},this.tour.element,this.own.element),this.tour.panel)}choice(t,e){let i=`${this.id}-${t}`,n=h("select",{id:i,onchange:()=>e(n.value)});return{select:n,element:h("span",{class:"wbx-choice"},h("label",{for:i},t),n)}}setChoices({animals:t,models:e,axes:i=[v]},{animal:n,model:a,along:o=v.name}){this.asked={at:this.asked?.at,animal:n,model:a,along:o};let r=i.map(({name:c,label:p})=>({name:c,title:M(p)})),l=[[this.animal,t,n],[this.along,r,o],[this.model,e,a]];for(let[{select:c},p,d]of l)c.replaceChildren(...p.map(({name:f,title:u})=>h("option",{value:f},u))),c.value=d;this.along.element.hidden=i.length<2,this.tour.offer()}showCurve(t,e=v){let i=e.name!==this.curve.axis.name;this.curve.show(t,e),i&&this.own.show(),this.tour.heardCurve()}showAnswer(t){this.answer=t;let{name:e}=this.curve.axis;this.asked={animal:t.species,model:t.model,along:e,at:t[e]},this.animal.select.value=t.species,this.model.select.value=t.model,this.pins.now(t),this.say(""),this.show(),this.pushing&&this.isPushed(t)?this.push():this.linked.heard(),t.provisional||queueMicrotask(()=>this.tour.heard())}showPushes(t){let e=document.activeElement===this.pushButton;this.showAnswer({...this.answer,scene:{...this.answer.scene,pushes:t}}),e&&this.viewer.pushes.element.querySelector("select")?.focus()}showBetween(t){let{answer:e}=this;!e?.scene||this.pins.answer||(this.fly(t?{...e.scene,flights:[t]}:e.scene,e.species),this.label(e,t?.summary))}compare(t){this.pins.pin(t)}say(t){this.state.textContent=t}setTheme(t){this.theme=t,this.root.dataset.theme=t,this.viewer?.setTheme(t)}has({animal:t,model:e,along:i=v.name,push:n}){let a=({select:o},r)=>[...o.options].some(l=>l.value===r);return[[this.animal,t],[this.along,i],[this.model,e]].every(o=>a(...o))&&!(n&&!this.onpush)}pushedAt(t){return this.onpush&&t.status==="converged"?t[this.curve.axis.name]:void 0}isPushed(t){let e=this.pushedAt(t);return e!==void 0&&e===t[this.curve.axis.name]}ask(t){this.asked={...this.asked,...t},this.linked.want(""),this.onask({...this.asked})}push(){this.pushing=!this.isPushed(this.answer),this.pushing?this.ask({at:this.pushedAt(this.answer)}):this.onpush()}tellPush(){let{answer:t}=this,e=this.pushedAt(t);if(this.pushButton.hidden=e===void 0||!!t.scene?.pushes,e===void 0)return;let i=this.isPushed(t)?"":`, at ${y(e,this.curve.axis.unit)}`;this.pushButton.textContent=`Push it with a gust${i}`}show(){let{answer:t}=this;if(!t)return;let e=this.pins.answer;this.root.dataset.status=t.status,this.verdict.show(t),this.gauges.show(t.gauges,e?.gauges),this.curve.mark(t[this.curve.axis.name]),this.curve.pin(e?.status==="converged"?e:void 0),this.numbers.replaceChildren(...rs(t,e)),this.picture.hidden=!t.scene,t.scene&&this.fly(this.pins.scene(t),t.species),this.label(t),t.scene||this.say("This flight tumbles before there is anything to show."),this.tellPush()}label({status:t},e=""){this.viewer&&(this.viewer.warning.textContent=t==="converged"?e:as,this.viewer.warning.classList.toggle("wbx-between",e!==""))}fly(t,e){let i=t.flights.length;if(this.blind)return;let n=e===this.whose&&i===this.count&&this.viewer?.ghost===this.pins.ghost;if(this.viewer)this.replace(t,n);else{try{this.viewer=new ut(this.picture,t,{theme:this.theme,compact:!0})}catch{this.blind=!0,this.picture.replaceChildren(h("p",{},"This browser cannot draw in three dimensions: WebGL is missing or switched off.")),this.own.show();return}this.own.show(),this.viewer.pushes.onchange=()=>this.onpushed()}e!==this.whose&&this.viewer.setBeat(1),[this.whose,this.count]=[e,i]}replace(t,e){let{camera:i,controls:n}=this.viewer.stage,[a,o]=[i.position.clone(),n.target.clone()];this.viewer.ghost=this.pins.ghost,this.viewer.replace(t),e&&(i.position.copy(a),n.target.copy(o),n.update())}destroy(){this.own.destroy(),this.curve.destroy(),this.viewer?.destroy(),this.root.remove()}};function rs(s,t){let e=new Map((t?.numbers??[]).map(([a,o])=>[a,o])),i=s.numbers.map(([a,o,r])=>{let l=[h("td",{},o),...t?[h("td",{},e.get(a)??"\u2013")]:[]];return h("tr",{},h("th",{scope:"row"},a),...l,h("td",{},r))});if(!t)return i;let n=["","now","pinned",""].map(a=>h("th",{scope:"col"},a));return[h("tr",{},...n),...i]}var hs=.5,at=class{constructor(t,e){this.answers=t,this.axis=e,this.flights=new Map}at(t){let{name:e,unit:i}=this.axis,n=this.answers.findIndex(d=>d[e]>=t),[a,o]=[this.answers[n-1],this.answers[n]];if(!a||!o||o[e]===t||!ue(a)||!ue(o))return;let[r,l]=[this.flight(a),this.flight(o)];if(!ls(r,l))return;let c=(t-a[e])/(o[e]-a[e]),p=`Picture between the wingbeats at ${x(a[e])} and ${y(o[e],i)}`;return{...cs(r,l,c),summary:p}}flight(t){return this.flights.has(t)||this.flights.set(t,new ft(t.scene.flights[0])),this.flights.get(t)}},ue=({status:s,scene:t})=>s==="converged"&&t;function ls(s,t){let[e,i]=[s.arrays.corners,t.arrays.corners];if(s.samples!==t.samples||e.length!==i.length)return!1;let n=(hs*s.semi_span)**2;for(let a=0;a<e.length;a+=3)if([0,1,2].reduce((r,l)=>r+(i[a+l]-e[a+l])**2,0)>n)return!1;return!0}function cs(s,t,e){let i=e<.5?s:t,n={};for(let a of Object.keys(i.arrays)){let[o,r]=[s.arrays[a],t.arrays[a]],l=o?.length===r?.length;n[a]=l?o.map((c,p)=>c+e*(r[p]-c)):i.arrays[a]}return{...i,arrays:n,frequency:s.frequency+e*(t.frequency-s.frequency)}}var ot=class{constructor(t,e){this.catalogue=e,this.lattices=new Map,this.pushes=new Map,this.asked=e.start,this.face=new R(t,{}),this.face.onask=i=>this.ask(i),this.face.curve.onslide=i=>this.slide(i),this.face.onpush=()=>this.push(),this.face.onpushed=()=>this.link(),this.face.has=i=>this.has(i),this.face.pushedAt=({species:i,model:n,axis:a=v})=>this.pushedAt({animal:i,model:n,along:a.name}),window.addEventListener("hashchange",()=>this.follow()),this.follow()}follow(){let t=this.fragment();this.asked=ds(this.asked,t),this.face.linked.want(t.push??""),this.ask(this.asked)}fragment(){let t=new URLSearchParams(location.hash.slice(1)),e={};this.catalogue.animals.some(({name:i})=>i===t.get("animal"))&&(e.animal=t.get("animal")),this.catalogue.models.some(({name:i})=>i===t.get("model"))&&(e.model=t.get("model"));for(let{name:i}of this.catalogue.axes)Number.isFinite(parseFloat(t.get(i)))&&([e.along,e.at]=[i,parseFloat(t.get(i))]);return t.get("push")&&(e.push=t.get("push")),e}has({push:t=!1,...e}){return this.catalogue.files.includes(`${F(e)}${t?"-pushes":""}.js`)}axes(t){let{axes:e,models:i}=this.catalogue;return e.filter(({name:n})=>i.some(({name:a})=>this.has({animal:t,model:a,along:n})))}models(t,e){return this.catalogue.models.filter(({name:i})=>this.has({animal:t,model:i,along:e}))}ask(t){let{animal:e}=t,i=this.axes(e),n=i.some(({name:c})=>c===t.along)?t.along:i[0].name,a=this.models(e,n),o=a.some(({name:c})=>c===t.model)?t.model:a[0].name,r=e===this.asked.animal&&n===t.along;this.asked={animal:e,along:n,model:o,at:r?t.at:void 0};let l=`${e}/${n}`;this.listed!==l&&this.face.setChoices({animals:this.catalogue.animals,models:a,axes:i},this.asked),this.listed=l,this.load()}load(){let t=F(this.asked);if(this.lattices.has(t))return this.show(this.lattices.get(t));this.face.say("Loading \u2026"),this.read(t)}read(t){let e=`data/${t}.js`;document.head.append(h("script",{src:e,onerror:()=>this.face.say(`The file ${e} could not be read.`)}))}async hold(t,e){let i=await this.decompressed(e);if(i){for(let n of i.answers){n.axis=i.axis;for(let a of n.gauges)a.source??=i.sources[a.name]}this.lattices.set(t,i),F(this.asked)===t&&this.show(i)}}pushedAt(t){return this.has({...t,push:!0})?this.lattices.get(F(t))?.first:void 0}push(){let t=F(this.asked),e=this.pushes.get(t);if(e)return this.face.showPushes(e);this.face.say("Loading the gusts \u2026"),this.read(`${t}-pushes`)}async holdPushes(t,e){let i=await this.decompressed(e);if(!i)return;this.pushes.set(t,i);let{asked:n}=this;F(n)===t&&n.at===this.pushedAt(n)&&this.face.showPushes(i)}async decompressed(t){try{return await ps(t)}catch{this.face.say("This browser cannot unpack the data; a newer one can.");return}}show(t){let{name:e}=t.axis,i=a=>Math.abs(a[e]-(this.asked.at??t.first)),n=t.answers.reduce((a,o)=>i(o)<i(a)?o:a);this.shown!==t&&(this.face.showCurve(t.curve,t.axis),this.between=new at(t.answers,t.axis)),this.shown=t,this.asked.at=n[e],this.face.showAnswer(n),this.link()}slide(t){this.sliding=t,this.due??=requestAnimationFrame(()=>{this.due=void 0;let e=this.sliding===void 0?void 0:this.between?.at(this.sliding);(e||this.isBetween)&&this.face.showBetween(e),this.isBetween=!!e})}link(){let{animal:t,model:e,along:i,at:n}=this.asked,a=this.face.linked.name;history.replaceState(null,"",`#${new URLSearchParams({animal:t,model:e,[i]:n,...a&&{push:a}})}`)}};function ds(s,{animal:t,model:e,along:i,at:n}){return{...t?{animal:t,along:i,at:n}:{animal:s.animal,along:i??s.along,at:n??s.at},model:e??s.model}}async function ps(s){let t=Uint8Array.from(atob(s),i=>i.charCodeAt(0)),e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return JSON.parse(await new Response(e).text())}function F({animal:s,model:t,along:e=v.name}){return[s,t,...e===v.name?[]:[e]].join("-")}var pt;globalThis.wingbeatExplorer={explore:(s,t={})=>new R(s,t),mount:gt,open:s=>pt=new ot(document.querySelector("main"),s),hold:(s,t)=>pt.hold(s,t),holdPushes:(s,t)=>pt.holdPushes(s,t)};})();
