// wingbeat explorer, made by viewer/build.mjs; sources sha256:61b13f2a09c7344f203ddcb73e454135716ca3ba4ab198191262ffe73caa5523
(()=>{var{Viewer:ot,Flight:rt,setView:ht,viewOf:lt,make:r,draw:m,capital:C,short:v,ticks:Z,mount:ct}=globalThis.wingbeatViewer;var x={name:"speed",unit:"m/s",label:"speed"};function y(i,t,e=3){return t?`${v(i,e)} ${t}`:v(i,e)}function dt({speed:i,axis:t=x,...e}){let s=t.name===x.name?"":`, ${t.label} ${y(e[t.name],t.unit)}`;return`at ${v(i)} m/s${s}`}function P(i){return Array.isArray(i)?i:[i,i]}var z=i=>i.plausible===!1;function pt(i){return i.certified?i.plausible===null?"certified, plausibility not known":`certified, ${i.plausible?"plausible":"not plausible"}`:"no certified wingbeat"}var w={left:46,right:16,top:14,bottom:38};function ut(i,t){let{axis:e,x:s,y:n,width:a,height:o,xTicks:h,yTicks:l}=i,c=o-w.bottom,p=(d,f,u,b,k="wbx-tick")=>m("text",{x:d,y:f,"text-anchor":u,class:k},b);return m("g",{"aria-hidden":"true"},...l.flatMap(d=>[m("line",{class:"wbx-grid",x1:w.left,x2:a-w.right,y1:n(d),y2:n(d)}),p(w.left-7,n(d)+4,"end",String(d))]),...h.map(d=>p(s(d),c+16,"middle",String(d))),m("line",{class:"wbx-axis",x1:w.left,x2:a-w.right,y1:c,y2:c}),p(a-w.right,c+31,"end",e.unit==="1"?e.label:`${e.label} [${e.unit}]`),p(w.left+2,w.top-3,"start",`${t.label} [${t.unit}]`))}function ft(i,{axis:t,x:e,y:s},n){let a=[];for(let o=1;o<i.length;o++){let[h,l]=[i[o-1],i[o]];if(!h.certified||!l.certified)continue;let c=[h,l].some(z)?"wbx-curve wbx-dashed":"wbx-curve",p={x1:e(h[t.name]),y1:s(h[n]),x2:e(l[t.name]),y2:s(l[n])};a.push(m("line",{class:c,...p}))}return m("g",{},...a)}function wt(i,{axis:t,x:e,y:s,height:n},a){let o=i.map(h=>{let l=e(h[t.name]);return h.certified?m("circle",{class:z(h)?"wbx-dot wbx-hollow":"wbx-dot",cx:l,cy:s(h[a]),r:4}):he(l,n-w.bottom-9)});return m("g",{},...o)}function mt(i,{x:t,height:e}){let s=e-w.bottom;return m("g",{},...i.map(n=>m("circle",{class:"wbx-pending",cx:t(n),cy:s,r:4})))}function he(i,t){return m("path",{class:"wbx-gap",d:`M${i-4} ${t-4}l8 8m0-8l-8 8`})}function gt(i,{x:t,y:e,height:s,width:n},a,o){let[h,l]=P(i.speed).map(t),[c,p]=i[a]===void 0?[]:P(i[a]).map(e),d=`${i.label}. Source: ${i.source}`,f={class:`wbx-measured wbx-${i.basis??"measured"}`,tabindex:"0",role:"img","aria-label":d,onpointerenter:()=>o(d),onpointerleave:()=>o(""),onfocus:()=>o(d),onblur:()=>o("")},u=p??w.top,b=c??s-w.bottom,k=Math.max(l-h,10),A=Math.max(b-u,10),q={x:Math.min((h+l-k)/2,n-w.right-k),y:(u+b-A)/2,width:k,height:A,rx:3};return m("g",f,m("rect",q))}var le=400;function bt({title:i,points:t},e,{x:s,y:n,height:a},{name:o,unit:h},l){let c=t.filter(u=>u[o]!==void 0),p=c.length<=le,d=c.map(u=>{let[b,k]=[s(u.speed),n(u[o])],A=u[`${o}Error`],E=Math.min(n(u[o]-A),a-w.bottom),q=A?[m("path",{d:`M${b} ${n(u[o]+A)}V${E}`})]:[],F=m("path",{class:"wbx-own-mark",d:`M${b} ${k-5}l5 5l-5 5l-5 -5z`});if(!p)return m("g",{},...q,F);let B=`${u.label||i}: ${y(u[o],h)} at ${y(u.speed,"m/s")}.`;return m("g",{onpointerenter:()=>l(B),onpointerleave:()=>l("")},...q,F)}),f=`${i}: ${c.length} measured points of your own`;return m("g",{class:`wbx-own wbx-own-${e%3}`,role:"img","aria-label":f},...d)}var W=[{name:"power",label:"Power",unit:"W"},{name:"frequency",label:"Wingbeats",unit:"Hz"}],ce={ArrowRight:1,ArrowUp:1,ArrowLeft:-1,ArrowDown:-1,PageUp:3,PageDown:-3},de=.5,_=class{constructor(t,e){this.act=t,this.onslide=()=>{},this.snap=e,this.quantity=W[0],this.data={points:[],measured:[],pending:[]},this.own=[],this.axis=x,this.at=0,this.svg=m("svg",{class:"wbx-chart"}),this.buttons=W.map(a=>r("button",{type:"button","aria-pressed":"false",onclick:()=>this.choose(a)},a.label));let s=r("div",{class:"wbx-pair",role:"group","aria-label":"Curve shown"},...this.buttons);this.note=r("p",{class:"wbx-note"}),this.title=r("h2");let n=r("div",{class:"wbx-row"},this.title,s);this.element=r("div",{class:"wbx-curve-box","data-part":"curve"},n,this.svg,this.note),this.buildHandle(),this.svg.addEventListener("pointerdown",a=>this.take(a)),this.svg.addEventListener("pointermove",a=>this.dragging&&this.drag(a));for(let a of["pointerup","pointercancel"])this.svg.addEventListener(a,()=>this.release());this.watcher=new ResizeObserver(()=>this.draw()),this.watcher.observe(this.svg),this.turn(x),this.choose(W[0])}turn(t){this.axis=t;let e=t.name===x.name;this.title.textContent=e?"Drag the point to fly faster or slower":`Drag the point to change the ${t.label}`,this.handle.setAttribute("aria-label",C(t.label))}buildHandle(){this.guide=m("line",{class:"wbx-guide"}),this.knob=m("circle",{class:"wbx-knob",r:9}),this.tag=m("text",{class:"wbx-tag","text-anchor":"middle"});let t={role:"slider",tabindex:"0","aria-orientation":"horizontal"};this.handle=m("g",{class:"wbx-handle",...t},this.guide,this.knob,this.tag),this.handle.addEventListener("keydown",e=>this.key(e))}choose(t){this.quantity=t,this.buttons.forEach((e,s)=>e.setAttribute("aria-pressed",String(W[s]===t))),this.draw()}show({points:t,measured:e=[],range:s,pending:n=[]},a=x){this.turn(a);let o=[...t].sort((h,l)=>h[a.name]-l[a.name]);this.data={points:o,measured:e,range:s,pending:n},this.draw()}showOwn(t){this.own=t,this.draw()}mark(t){this.dragging||(this.at=t,this.place(t))}pin(t){t!==this.pinned&&(this.pinned=t,this.draw())}draw(){let{clientWidth:t,clientHeight:e}=this.svg;if(!t||!e)return;let{name:s}=this.quantity,{points:n}=this.data,a=c=>s==="power"&&c.frequency===void 0,o=this.data.measured.filter(c=>c[s]!==void 0||a(c));this.scale=this.scales(t,e,o),this.svg.setAttribute("viewBox",`0 0 ${t} ${e}`);let h=c=>this.note.textContent=c||this.legend(o),l=document.activeElement===this.handle;this.svg.replaceChildren(ut(this.scale,this.quantity),...o.map(c=>gt(c,this.scale,s,h)),...this.drawn.map((c,p)=>bt(c,p,this.scale,this.quantity,h)),ft(n,this.scale,s),mt(this.data.pending,this.scale),wt(n,this.scale,s),...this.drawPin(s),this.handle),l&&this.handle.focus({preventScroll:!0}),h(""),this.place(this.at)}get drawn(){return this.axis.name===x.name?this.own:[]}scales(t,e,s){let{points:n}=this.data,{name:a}=this.quantity,{axis:o}=this,h=[...n.map(g=>g[o.name]),...this.data.range??[]],[l,c]=h.length?[Math.min(...h),Math.max(...h)]:[0,20],p=this.drawn.flatMap(g=>g.points),d=p.map(g=>g.speed),f=[l,c,...s.flatMap(({speed:g})=>P(g)),...d],u=Math.max(.04*(c-l),.02*Math.abs(c))||.2,b=Math.min(...f),[k,A]=[b<0?b-u:Math.max(b-u,0),Math.max(...f)+u],E=n.filter(g=>g.certified).map(g=>g[a]),q=s.filter(g=>g[a]!==void 0).map(g=>P(g[a])[1]),F=p.filter(g=>g[a]!==void 0).map(g=>g[a]),B=1.12*Math.max(...E,...q,...F,1e-9),ne=g=>w.left+(g-k)/(A-k)*(t-w.left-w.right),ae=g=>e-w.bottom-g/B*(e-w.bottom-w.top),oe=g=>k+(g-w.left)/(t-w.left-w.right)*(A-k),re=Z(k,A,t<500?5:10);return{axis:o,x:ne,y:ae,width:t,height:e,valueAt:oe,first:l,last:c,xTicks:re,yTicks:Z(0,B,4)}}drawPin(t){if(this.pinned?.[this.axis.name]===void 0)return[];let{x:e,y:s}=this.scale,[n,a]=[e(this.pinned[this.axis.name]),s(this.pinned[t])];return[m("path",{class:"wbx-pin",d:`M${n} ${a-8}l8 8l-8 8l-8 -8z`})]}legend(t){let{points:e}=this.data,s=[];return e.some(n=>n.certified&&z(n))&&s.push("dashed: not plausible"),e.some(n=>!n.certified)&&s.push("cross: no certified wingbeat"),this.data.pending.length&&s.push("rings on the axis: still to be computed"),t.length&&s.push("bars behind: real animals (point at one for its source)"),s.join("; ")}place(t){if(!this.scale)return;let{x:e,y:s,height:n,first:a,last:o}=this.scale,{name:h,unit:l}=this.quantity,c=e(Math.min(Math.max(t,a),o)),p=this.heightAt(t,h),d=n-w.bottom,f=p===void 0?d-9:s(p);for(let[A,E]of Object.entries({x1:c,x2:c,y1:f,y2:d}))this.guide.setAttribute(A,E);this.knob.setAttribute("cx",c),this.knob.setAttribute("cy",f),this.tag.setAttribute("x",c),this.tag.setAttribute("y",f<w.top+20?f+26:f-16);let u=this.nearest(t),b=u&&Math.abs(u[this.axis.name]-t)<1e-9?u:void 0;this.tag.textContent=b?.certified&&!this.dragging?`${v(b[h])} ${l}`:"",this.handle.setAttribute("aria-valuemin",a),this.handle.setAttribute("aria-valuemax",o),this.handle.setAttribute("aria-valuenow",t);let k=b?.certified?`${v(b.power)} W, ${v(b.frequency)} Hz, `:"";this.handle.setAttribute("aria-valuetext",y(t,this.axis.unit)+(b?`: ${k}${pt(b)}`:""))}heightAt(t,e){let{points:s}=this.data,n=c=>c[this.axis.name],a=s.findIndex(c=>n(c)>=t-1e-9);if(a<0)return;let[o,h]=[s[a],s[a-1]];if(Math.abs(n(o)-t)<1e-9)return o.certified?o[e]:void 0;if(!h?.certified||!o.certified)return;let l=(t-n(h))/(n(o)-n(h));return h[e]+l*(o[e]-h[e])}nearest(t){let e=s=>Math.abs(s[this.axis.name]-t);return this.data.points.reduce((s,n)=>s&&e(s)<=e(n)?s:n,void 0)}take(t){t.button!==0||!this.scale||(this.dragging=!0,this.svg.setPointerCapture(t.pointerId),this.handle.focus({preventScroll:!0}),this.drag(t))}drag(t){let{first:e,last:s,valueAt:n}=this.scale,a=t.clientX-this.svg.getBoundingClientRect().left,o=Math.min(Math.max(n(a),e),s);this.place(o),this.ask(this.snap?this.nearest(o)?.[this.axis.name]:Math.round(10*o)/10),this.onslide(o)}release(){this.dragging&&(this.dragging=!1,this.place(this.at),this.onslide())}key(t){let e=ce[t.key],s={Home:"first",End:"last"}[t.key];!e&&!s||t.ctrlKey||t.metaKey||t.altKey||!this.scale||(t.preventDefault(),t.stopPropagation(),s?this.ask(this.scale[s]):this.snap?this.ask(this.beside(e)):this.ask(Math.min(Math.max(this.at+e*de,this.scale.first),this.scale.last)),this.place(this.at))}beside(t){let{points:e}=this.data,s=e.indexOf(this.nearest(this.at));return e[Math.min(Math.max(s+t,0),e.length-1)]?.[this.axis.name]}ask(t){t===void 0||t===this.at||(this.at=t,this.act(t))}destroy(){this.watcher.disconnect()}};var xt=2,j=class{constructor(){this.rows=new Map,this.element=r("ul",{class:"wbx-gauges","aria-label":"Numbers and their plausible ranges"})}show(t,e){let s=new Map((e??[]).map(o=>[o.name,o]));for(let o of t)this.rows.has(o.name)||this.rows.set(o.name,new tt),this.rows.get(o.name).show(o,s.get(o.name));let n=t.map(({name:o})=>this.rows.get(o).element);n.length===this.element.children.length&&n.every((o,h)=>o===this.element.children[h])||this.element.replaceChildren(...n)}},tt=class{constructor(){this.label=r("span",{class:"wbx-label"}),this.value=r("span",{class:"wbx-value"}),this.word=r("span",{class:"wbx-word"}),this.band=r("span",{class:"wbx-band"}),this.mark=r("span",{class:"wbx-mark"}),this.pinned=r("span",{class:"wbx-mark wbx-was"}),this.bar=r("span",{class:"wbx-bar","aria-hidden":"true"},this.band,this.pinned,this.mark),this.range=r("p"),this.source=r("p");let t=r("summary",{},this.label,this.value,this.word,this.bar);this.element=r("li",{},r("details",{},t,this.range,this.source))}show(t,e){let{label:s,value:n,unit:a,low:o,high:h,source:l}=t,c=o!==null||h!==null;this.element.dataset.gauge=t.name,this.label.textContent=s,this.value.textContent=n===null?"\u2013":y(n,a),this.value.dataset.exact=n,this.word.textContent=pe(t),this.element.className={true:"wbx-inside",false:"wbx-outside"}[t.inside]??"";let p=t.given?"Given, not predicted. ":"";this.range.textContent=p+(c?`Plausible: ${ue(t)}`:"No plausible range is known."),this.source.textContent=c?`Source: ${l}`:"";let d=h!==null?xt*h:2.5*o,f=o!==null&&o<0?xt*o:0,u=b=>`${100*Math.min(Math.max((b-f)/(d-f),0),1)}%`;this.bar.hidden=!c,c&&(this.band.style.left=u(o??f),this.band.style.right=`calc(100% - ${u(h??d)})`,this.put(this.mark,n,f,d,u),this.put(this.pinned,e?.value??null,f,d,u))}put(t,e,s,n,a){t.hidden=e===null,e!==null&&(t.style.left=a(e),t.classList.toggle("wbx-beyond",e>n||e<s))}};function pe({value:i,low:t,high:e,inside:s,limited:n,given:a}){return i===null?"not defined":t===null&&e===null?a?"given":"no range known":s?a?"given":n?"set by a limit":"inside":e!==null&&i>e?"above":"below"}function ue({low:i,high:t,unit:e}){return i===null?`at most ${y(t,e)}`:t===null?`at least ${y(i,e)}`:`${y(i,"")} to ${y(t,e)}`}var D=class{constructor(t){this.face=t,this.wanted=""}get name(){return this.wanted||(this.face.viewer?.pushes.name??"")}want(t){this.wanted=t}heard(){let{answer:t,viewer:e}=this.face;if(!(!this.wanted||!t||t.provisional))if(!e||!this.face.isPushed(t))this.wanted="";else if(!t.scene.pushes)this.face.onpush();else{let{wanted:s}=this;this.wanted="",e.pushes.open(s),this.face.onpushed()}}};var U=class{constructor(){this.texts=[]}add(t){this.texts.includes(t)||this.texts.push(t)}get told(){let t=this.texts.length-8;return t<=0?this.texts:[...this.texts.slice(0,8),`and ${t} more like these`]}};function yt(i){if(!(i.size<=2e6))return`The file has ${(i.size/1e6).toFixed(1)} MB; at most ${2e6/1e6} MB are read.`}function kt(i,t){let e=i.replace(/^\uFEFF/,"").split(/\r\n|\r|\n/).map((l,c)=>({line:l,at:c+1})).filter(({line:l})=>l.trim()&&!l.startsWith("#"));if(e.length<2){t.add("The file has no rows: the first line names the columns, and each line below it is one row.");return}let s=["	",";",","].find(l=>e[0].line.includes(l))??",",n=vt(e[0].line,s),a=e.slice(1).map(({line:l,at:c})=>({at:c,cells:vt(l,s)}));a.length>5e3&&t.add(`The file has ${a.length} rows; at most 5000 are read.`);for(let{at:l,cells:c}of a.slice(0,5e3)){let[p,d]=[c.length,n.length];p!==d&&t.add(`Line ${l} has ${p} cells, the header has ${d}.`)}let o=/^#\s*frequency\s*(?:\[hz\])?\s*=\s*(.+)$/im.exec(i),h=o?R(o[1].trim(),"frequency",1,t,{low:1e-9}):void 0;return{header:n,rows:a.slice(0,5e3),frequency:h}}function vt(i,t){let e=[""],s=!1;for(let n=0;n<i.length;n++){let a=i[n];a==='"'&&s&&i[n+1]==='"'?e[e.length-1]+=i[++n]:a==='"'?s=!s:a===t&&!s?e.push(""):e[e.length-1]+=a}return e.map(n=>n.trim())}var fe=["alpha","alphadeg","aoa","aoadeg","angleofattack","angleofattackdeg","\u03B1"],we=["phase","time"];function $t(i){return i.split(/\r\n|\r|\n/,60).some(t=>{let s=t.toLowerCase().replace(/[[(][^\])]*[\])]/g,"").split(/[\t;,]/.test(t)?/[\t;,]/:/\s+/).map(a=>a.replace(/[^a-zα]/g,"")),n=(...a)=>a.some(o=>s.includes(o));return n("cl","liftcoefficient")&&n("cd","dragcoefficient",...fe)&&!n(...we)})}function Tt(i){let t=/[[(]([^\])]*)[\])]/.exec(i),s=i.replace(/[[(].*$/,"").toLowerCase().trim().split(/[\s_-]+/).filter(Boolean);if(t)return{words:s,unit:t[1].trim().toLowerCase()};for(let[n,a]of me){let o=s.slice(-n.length);if(s.length>n.length&&n.every((h,l)=>h===o[l]))return{words:s.slice(0,-n.length),unit:a}}return{words:s,unit:""}}var me=[[["m","s"],"m/s"],[["m/s"],"m/s"],[["km","h"],"km/h"],[["mps"],"m/s"],[["hz"],"hz"],[["w"],"w"],[["mw"],"mw"],[["s"],"s"],[["ms"],"ms"],[["deg"],"deg"],[["degrees"],"deg"],[["rad"],"rad"]];function R(i,t,e,s,{low:n=-1/0,high:a=1/0}={}){if(i===void 0||/^(|na|n\/a|nan|-)$/i.test(i))return;if(/^[+-]?\d+,\d+$/.test(i))return s.add(`Line ${e}, ${t}: \u201C${i}\u201D has a decimal comma; write a decimal point.`),NaN;let o=/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(i)?Number(i):NaN;if(!Number.isFinite(o))return s.add(`Line ${e}, ${t}: \u201C${i.slice(0,40)}\u201D is no number.`),NaN;if(o<n||o>a){let h=a===1/0?`at least ${n}`:`from ${n} to ${a}`;return s.add(`Line ${e}, ${t}: ${i} must be ${h}.`),NaN}return o}var ge=["speed","airspeed","velocity","v","u"],St=["power","p"],be=["metabolic","metab","met","input","respirometry","aerobic","chemical"],At=["frequency","freq","f","beats"],xe=["error","err","sd","se","sem","std","uncertainty"],ve=["label","name","animal","individual","species","source"],ye={speed:["m/s","ms-1","m s-1"],power:["w"],frequency:["hz","1/s","s-1"]},ke={speed:"m/s",power:"W",frequency:"Hz"},et=(i,t)=>t.includes(i.at(-1));function Ct(i){let t=i.map((a,o)=>({text:a,place:o,...Tt(a)})),e=a=>a.words.some(o=>xe.includes(o)),s=t.find(a=>et(a.words,ge)&&!e(a));if(s)return{kind:"flights",columns:$e(t,s,e)};let n=t.find(a=>["phase","time","t"].includes(a.words[0])&&a.words.length===1);return n?{kind:"motion",clock:n,columns:t.filter(a=>a!==n)}:{kind:void 0}}function $e(i,t,e){let s={speed:t},n=a=>a.words.some(o=>be.includes(o));s.metabolic=i.find(a=>n(a)&&!e(a)),s.power=i.find(a=>et(a.words,St)&&!n(a)&&!e(a)),s.frequency=i.find(a=>et(a.words,At)&&!e(a));for(let a of i.filter(o=>e(o)&&!n(o))){let o=a.words.some(h=>At.includes(h))?"frequency":a.words.some(h=>St.includes(h))||s.power?"power":"frequency";s[`${o}Error`]??=a}return s.label=i.find(a=>a.words.some(o=>ve.includes(o))),s}function Mt({rows:i},t,e){for(let[a,o]of Object.entries(ye))for(let h of[t[a],t[`${a}Error`]])h?.unit&&!o.includes(h.unit)&&e.add(`Column \u201C${h.text}\u201D is in ${h.unit}; convert it to ${ke[a]}.`);t.metabolic&&!t.power&&!t.frequency?e.add(`Column \u201C${t.metabolic.text}\u201D is metabolic power; the curve shows mechanical power. wingbeat curve --data compares both.`):!t.power&&!t.frequency&&e.add("No column is named power or frequency; at least one of them must stand beside the speed.");let s={speed:{low:0,high:200}},n=[];for(let{at:a,cells:o}of i){let h={label:o[t.label?.place]??""};for(let l of["speed","power","frequency","powerError","frequencyError"]){let c=t[l];c&&(h[l]=R(o[c.place],c.text,a,e,s[l]??{low:0}))}h.speed===void 0&&e.add(`Line ${a} has no speed.`),(h.power!==void 0||h.frequency!==void 0)&&n.push(h)}return!n.length&&!e.texts.length&&e.add("No row has a speed with a power or a frequency."),n}function Ot(i,t,e,s){let{rows:n}=i;n.length<3&&s.add("A wingbeat needs at least three rows.");let a=Te(i,t,s),o=a.map((l,c)=>c).sort((l,c)=>a[l]-a[c]),h=o.map(l=>a[l]);return e.map(l=>Me(l,o.map(c=>n[c]),h,s))}function Te({rows:i,frequency:t},e,s){let n=e.words[0]!=="phase",a=["","s","ms"].includes(e.unit);n&&!a&&s.add(`Column \u201C${e.text}\u201D must be in s or ms.`);let o=n?{}:{low:0,high:1},h=i.map(({at:d,cells:f})=>{let u=R(f[e.place],e.text,d,s,o);return u===void 0&&s.add(`Line ${d} has no ${n?"time":"phase"}.`),u});if(!n)return h;let[l,c]=[h[0],h.at(-1)];if(!t)return c>l||s.add(`Column \u201C${e.text}\u201D: the last time must be later than the first.`),h.map(d=>(d-l)/(c-l));let p=t*(e.unit==="ms"?.001:1);return h.map(d=>((d-l)*p%1+1)%1)}var Se={pitch:"wing_pitch",span_fraction:"span_ratio"},Ae=["","-","1","rad","rad/s","m","m/s","n","w","s","hz"],Ce=["flap","pitch","twist","fold","sweep","alpha"];function Me({text:i,words:t,unit:e,place:s},n,a,o){let h=t.some(f=>Ce.includes(f))&&!t.includes("rate"),l=["deg","degrees","\xB0","deg/s"].includes(e);!l&&!Ae.includes(e)?o.add(`Column \u201C${i}\u201D is in ${e}; convert it to SI units.`):h&&!l&&e!=="rad"&&o.add(`Column \u201C${i}\u201D is an angle: name its unit, as in \u201C${t.join("_")}_deg\u201D.`);let c=l?Math.PI/180:1,p=n.map(({at:f,cells:u})=>{let b=R(u[s],i,f,o);return c*(b??NaN)}),d=t.join("_");return{name:Se[d]??d,title:i,phase:a,values:p}}var Oe="A CSV file of measured flights has the columns speed [m/s] and mechanical power [W] or frequency [Hz], and may have error and label. A CSV file of a wingbeat has phase or time [s], and columns such as flap_deg or pitch_deg. With time, the rows are one beat from the first to the last, unless a line \u201C# frequency [Hz] = 8.2\u201D says how long a beat is. A polar has alpha, CL and CD; those of XFOIL, XFLR5, AeroDyn and others are read as they are.",Ee="The first line must name the columns: speed with power or frequency, for measured flights; phase or time with flap_deg and others, for a wingbeat; or alpha, CL and CD, for a polar.",qe="Drop a file anywhere on this page, or choose one. A CSV file of flights or a wingbeat stays in your browser: nothing of it is uploaded.",Pe=/\.(dat|pol|plr|polar|drg|lft)$/i,Et=i=>/\s/.test(i)?`"${i}"`:i,H=class{constructor(t){this.face=t,this.shown=[];let e={type:"file",multiple:!0,accept:".csv,.txt,.tsv,.toml,.dat,.pol,.plr,.polar,.drg,.lft"};this.input=r("input",{...e,onchange:()=>this.chosen()});let s=r("label",{class:"wbx-file"},r("span",{},"Choose a file"),this.input);this.list=r("ul",{class:"wbx-own-list"}),this.state=r("div",{class:"wbx-own-state",role:"status"}),this.element=r("section",{class:"wbx-own-data"},r("h2",{},"Your own data"),r("p",{},qe),s,this.list,this.state,r("details",{class:"wbx-more"},r("summary",{},"What the file must hold"),r("p",{},Oe))),this.listen()}listen(){let t=new AbortController,e=o=>o.dataTransfer?.types.includes("Files"),{signal:s}=t,n=(o,h)=>document.addEventListener(o,l=>e(l)&&h(l),{signal:s}),a=o=>this.face.root.classList.toggle("wbx-dropping",o);n("dragover",o=>{o.preventDefault(),a(!0)}),n("dragleave",o=>o.relatedTarget===null&&a(!1)),n("drop",o=>{o.preventDefault(),a(!1),this.take([...o.dataTransfer.files])}),this.destroy=()=>t.abort()}chosen(){this.take([...this.input.files]),this.input.value=""}async take(t){this.state.replaceChildren(),this.sent={};for(let e of t)await this.read(e)}async read(t){if(!/\.(csv|tsv|txt)$/i.test(t.name))return this.other(t);let e=new U,s=yt(t),n=s?"":await t.text();if($t(n))return this.other(t,!0);s?e.add(s):this.interpret(t.name,n,e),e.texts.length&&this.refuse(t.name,e.told)}interpret(t,e,s){let n=kt(e,s);if(!n)return;let{kind:a,clock:o,columns:h}=Ct(n.header);if(a==="flights"){let l=h.metabolic&&`; not drawn, because the curve shows mechanical power: ${h.metabolic.text}`;this.add({title:t,kind:a,points:Mt(n,h,s),left:l??""},s)}else a==="motion"?this.add({title:t,kind:a,curves:Ot(n,o,h,s)},s):s.add(Ee)}other(t,e=Pe.test(t.name)){if(this.face.onfile)return this.send(t,e?"polar":"species file");if(e)return this.fly(t.name);if(!/\.toml$/i.test(t.name))return this.refuse(t.name,["Its name must end in .csv, in .toml for a species file, or in .pol or .dat for a polar."]);let s=`wingbeat explore --static my-explorer --animals ${Et(t.name)}`,n=`${t.name} is a species file. Its flights must be solved, which this page cannot do.`;this.say(r("p",{},`${n} This command makes a page with them:`),r("code",{},s))}send(t,e){let s=this.sent[e];return s?this.refuse(t.name,[`${s} is read, and a flight has one ${e}. Drop this one alone.`]):(this.sent[e]=t.name,this.face.onfile(t))}fly(t){let{species:e,speed:s}=this.face.answer??{species:"pigeon",speed:10},n=`${t} is a polar. Flights with it must be solved, which this page cannot do.`,a=`wingbeat orbit ${e} --speed ${s} --aero ${Et(t)}`;this.say(r("p",{},`${n} This command flies it:`),r("code",{},a))}refuse(t,e){this.say(r("p",{},`${t} is not shown:`),r("ul",{},...e.map(s=>r("li",{},s))))}say(...t){this.state.append(...t),this.state.scrollIntoView({block:"nearest"})}add(t,e){e.texts.length||(this.shown=[...this.shown.filter(({title:s})=>s!==t.title),t],this.show(),t.points&&this.face.curve.element.scrollIntoView({block:"nearest"}))}remove(t){this.shown=this.shown.filter(e=>e!==t),this.show(),this.input.focus()}show(){let t=this.shown.filter(({kind:e})=>e==="flights");this.face.curve.showOwn(t),this.overlay(),this.list.replaceChildren(...this.shown.map(e=>this.row(e,t.indexOf(e))))}overlay(){let{viewer:t}=this.face,e=this.shown.flatMap(({title:s,curves:n=[]})=>n.map(a=>({...a,file:s})));this.drawn=t?.overlay(e)??[]}row(t,e){let s=e<0?"wbx-own-line":`wbx-own-${e%3}`,n=r("span",{class:`wbx-own-key ${s}`,"aria-hidden":"true"}),a={type:"button","aria-label":`Remove ${t.title}`},o=r("button",{...a,onclick:()=>this.remove(t)},"Remove");return r("li",{},n,r("span",{},this.words(t)),o)}words({title:t,points:e,curves:s,left:n}){let{viewer:a,blind:o}=this.face,{axis:h}=this.face.curve;if(e&&h.name!==x.name)return`${t}: not drawn, because this curve shows the ${h.label}, not the speed`;if(e)return`${t}: ${e.length} ${e.length===1?"point":"points"} behind the curve${n}`;if(!a)return`${t}: ${o?"not drawn, because the page has no picture":"drawn with the first picture"}`;let[l,c]=[!0,!1].map(d=>s.filter(({name:u})=>this.drawn.includes(u)===d).map(u=>u.title).join(", ")),p=c&&`; not drawn, because the plots have no such series: ${c}`;return l?`${t}: ${l} as dashed lines in the plots${p}`:`${t}${p}`}};var V=class{constructor(t){this.onpin=void 0,this.answer=void 0,this.ghost=!0,this.act=t,this.button=r("button",{type:"button",onclick:()=>this.toggle()}),this.way=r("button",{type:"button",onclick:()=>this.turn()}),this.words=r("p"),this.element=r("div",{class:"wbx-pins"},this.button,this.way,this.words),this.tell()}now(t){this.current=t,this.button.disabled=!t.scene&&!this.answer}toggle(){this.onpin?this.onpin(!this.answer):this.pin(this.answer?void 0:this.current)}pin(t){this.answer=t,this.tell(),this.act()}turn(){this.ghost=!this.ghost,this.tell(),this.act()}tell(){this.button.textContent=this.answer?"Remove the comparison":"Pin this flight to compare",this.way.textContent=this.ghost?"Show side by side":"Show as a ghost",this.way.hidden=this.words.hidden=!this.answer;let t=this.ghost?"shown pale":"farther away in the side view";this.words.textContent=this.answer?`Pinned, ${t}: ${qt(this.answer)}.`:""}scene(t){if(!this.answer?.scene)return t.scene;let[e,s]=[t,this.answer].map(n=>({...n.scene.flights[0],label:qt(n)}));return{...t.scene,flights:[e,s]}}};function qt(i){return`${i.title} ${dt(i)}, model: ${i.model_title}`}var Pt=`.wbx-row {
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
`;var Lt=`.wbx-say {
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
`;var Nt=`.wbx-judged {
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
`;var zt=`.wbx-own-data {
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
`;var Rt=`.wbx {
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
`;var It=`.wbx-tours ul {
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
`;var Ft=Rt+Lt+Pt+Nt+zt+It;var $=i=>`${v(i)} W`,T=i=>i.speed?`at ${v(i.speed)} m/s`:"in hover",Bt=i=>`${v(100*i,2)} %`;function st(i,t){let e=i.numbers.find(([s])=>s===t);return e&&[e[1],e[2]].filter(Boolean).join(" ")}function it(i,t){return i.gauges.find(e=>e.name===t&&e.value!==null)}var S=(i,t)=>i?[t(i)]:[];function M(i,t,e=$){let[s,n]=[e(i),e(t)];return s===n?`stays at ${n}`:`${t>i?"rises":"falls"} from ${s} to ${n}`}function Wt({spent:i},t){let e=Object.values(i).reduce((s,n)=>s+n,0);return i[t]/e}var Be=/(\d[\d.]*(?:e[+-]?\d+)? (?:m\/s|W\/kg|W|Hz|%|deg|g|m|beats?)(?![\w/]))/;function _t(i){return i.split(Be).map((t,e)=>e%2?r("b",{},t):t)}var We={profile:"profile power, the drag of the wings",induced:"induced power itself",parasite:"the drag of body and tail",unsteady:"that of rotation and added mass"};function jt({spent:i}){let[t,e]=Object.entries(i).reduce((s,n)=>n[1]>s[1]?n:s);return`${We[t]}, with ${$(e)}`}function Dt({value:i,low:t,high:e,unit:s,inside:n}){let a=h=>[v(h),s].filter(Boolean).join(" ");if(n===null)return`${a(i)}; no plausible range is known`;if(n)return`${a(i)}, inside the plausible range`;let o=i>e?`at most ${a(e)}`:`at least ${a(t)}`;return`${a(i)}; plausible is ${o}`}var _e={upward:"from below",downward:"from above",head:"from ahead",tail:"from behind"};function G({direction:i,size:t}){return`a gust ${_e[i]} of up to ${v(t)} m/s`}var O=i=>`${v(i)} Hz`,Ut=i=>`${v(i)} m`;function Ht(i){let t=it(i,"flap_amplitude");return t?[`The wings flap ${v(t.value)} ${t.unit} to either side of their mean.`]:[]}function Vt(i,t){return i>=t?"has enough for that":`would lack ${$(t-i)}`}function Gt(i){let t=st(i,"a small disturbance");return t==="decays"?["A small disturbance decays."]:t==="grows"?["But a small disturbance grows, as long as the wingbeat does not react."]:[]}var I={animal:"robofalcon2",model:["paper","animal"]},Yt={name:"robot",title:"Build a robot",teaser:"From weight and span to a gait, and to what the motor must give.",steps:[{name:"weight",title:"Start from the weight",flight:{...I,at:"cheapest"},view:{camera:"front",arrows:!1},look:"picture",tell:({now:i,semiSpan:t})=>[`This ${i.title} has a mass of ${st(i,"mass")} and two wings of ${Ut(t)} each.`,"Over a beat, the wings must carry the weight and balance the drag.","At the end of the beat the body must have the attitude and the velocities that it began with."]},{name:"gait",title:"Find a gait that closes",flight:{...I,at:"cheapest"},view:{camera:"side",arrows:!0},look:"picture",tell:({now:i})=>[`The solver looks for a wingbeat that repeats itself. It beats at ${O(i.frequency)} ${T(i)}.`,...Ht(i),"Arrows show the air load on each strip of the wing."]},{name:"motor",title:"What the motor must give",flight:{...I,at:"cheapest"},view:{camera:"side",arrows:!0},look:"gauges",tell:({now:i})=>[`The hinges of the wings need ${$(i.power)}: the mean over a beat, braking not counted.`,`That is ${$(i.power/i.mass)} for each kilogram of the robot.`,"Gears and motor lose some of what they draw, so the battery must give more."]},{name:"slow",title:"Slow flight",flight:{...I,at:"first"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:i,seen:t})=>[`The slowest flight computed here, ${T(i)}, needs ${$(i.power)}.`,...S(t.gait,e=>`Against the cheapest flight the frequency ${M(e.frequency,i.frequency,O)}.`)]},{name:"fast",title:"Fast flight",flight:{...I,at:"last"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:i,seen:t})=>[`${C(T(i))} it needs ${$(i.power)}.`,...S(t.gait,({power:e})=>`A motor sized for the cheapest flight, with ${$(e)}, ${Vt(e,i.power)}.`),"For a robot of your own, write its numbers into a species file and drop it on this page."]}]},K={animal:"pigeon",model:["paper","animal"],at:"pushed"},Kt={direction:"tail",feedback:!1},Xt={name:"tumbling",title:"Why it tumbles",teaser:"One gust, first with a fixed wingbeat, then with feedback.",steps:[{name:"orbit",title:"A flight that repeats itself",flight:K,view:{camera:"side",arrows:!1},look:"picture",tell:({now:i})=>[`${C(T(i))} the pigeon flies a beat that ends as it began. Undisturbed, it would go on for ever.`,...Gt(i)]},{name:"free",title:"A gust, and a wingbeat that does not react",flight:K,view:{camera:"side",arrows:!1},push:Kt,look:"picture",tell:({push:i})=>[`The pigeon meets ${G(i)}. Its wings go on beating as before.`,`It is ${i.outcome}.`]},{name:"held",title:"The same gust, with feedback",flight:K,view:{camera:"side",arrows:!1},push:{...Kt,feedback:!0},look:"picture",tell:({push:i})=>[`Again ${G(i)}. Now feedback sees attitude and velocities once in each beat, and changes the wingbeat.`,`It is ${i.outcome}.`]},{name:"again",title:"Push it yourself",flight:K,view:{camera:"side",arrows:!1},push:{direction:"upward",feedback:!1},look:"picture",tell:({push:i})=>[`Now ${G(i)}, again without feedback. The pigeon is ${i.outcome}.`,"Below the picture you can choose the gust yourself.","The feedback follows from the equations of motion; how birds do it is not modelled."]}]};var Jt={name:"hovering",title:"Why hovering costs",teaser:"A hummingbird slows down, and its power rises.",steps:[{name:"cheap",title:"The cheapest flight",flight:{animal:"annas-hummingbird",model:"animal",at:"cheapest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i})=>[`Of the speeds computed here, this hummingbird needs the least power ${T(i)}: ${$(i.power)}.`,"To stay up it must push air down. The downwash tilts the air loads back, and that costs induced power.",`It is ${$(i.spent.induced)} here, ${Bt(Wt(i,"induced"))} of what is spent on the air.`]},{name:"slow",title:"Slower, with less air to push",flight:{animal:"annas-hummingbird",model:"animal",at:"early"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i,seen:t})=>[`${C(T(i))} less air passes the wings in each second, and all of it must go down faster.`,...S(t.cheap,e=>`Induced power ${M(e.spent.induced,i.spent.induced)}.`)]},{name:"hover",title:"No wind but its own",flight:{animal:"annas-hummingbird",model:"animal",at:"first"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:i,seen:t})=>[`${C(T(i))} the bird beats at ${O(i.frequency)}.`,...i.speed?[]:["What moves the air past its wings is their beat alone."],...S(t.cheap,e=>`Against the cheapest flight, power ${M(e.power,i.power)}.`),`Of what is spent on the air, the largest part is ${jt(i)}.`]},{name:"fast",title:"Fast flight",flight:{animal:"annas-hummingbird",model:"animal",at:"last"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i,seen:t})=>[`${C(T(i))} air is plentiful, but it drags on body and wings.`,...S(t.hover,e=>`Against the slowest flight, induced power ${M(e.spent.induced,i.spent.induced)}.`),...S(t.hover,e=>`The power against the drag of body and tail ${M(e.spent.parasite,i.spent.parasite)}.`)]},{name:"muscle",title:"Can its muscle do it?",flight:{animal:"annas-hummingbird",model:"animal",at:"first"},view:{camera:"front",arrows:!1},look:"gauges",tell:({now:i})=>[`Back ${T(i)}. Power per mass is ${Dt(it(i,"positive_power_per_mass"))}.`,"The bars show where the other numbers lie. Now drag the point yourself."]}]},nt={animal:"bat",model:"paper",at:"cheapest"},Qt={...nt,model:"dickinson"},Zt={name:"coefficients",title:"A plate against a fruit fly",teaser:"The same bat in the same air; only the measured wing differs.",steps:[{name:"plate",title:"A bat on flat plates",flight:nt,view:{camera:"oblique",arrows:!0},look:"picture",tell:({now:i})=>["The forces of the air were measured once, on another wing. The model uses them for every strip of this one.","Here it was a flat plate (Su et al. 2023).",`So the bat beats at ${O(i.frequency)} and needs ${$(i.power)} ${T(i)}.`]},{name:"fly",title:"The same bat, a fruit fly's wing",flight:Qt,placeOf:"plate",view:{camera:"oblique",arrows:!0},pin:"plate",look:"picture",tell:({now:i,seen:t})=>["The coefficients now come from a model of a fruit fly's wing in oil (Dickinson et al. 1999).",...S(t.plate,()=>"Animal and speed are the same; the ghost in the picture flies on plates."),...S(t.plate,e=>`The frequency ${M(e.frequency,i.frequency,O)}.`),...S(t.plate,e=>`Power ${M(e.power,i.power)}.`)]},{name:"fast",title:"Faster, on plates",flight:{...nt,at:"last"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i,seen:t})=>[`${C(T(i))}, on plates again, the bat needs ${$(i.power)}.`,...S(t.plate,e=>`The frequency ${M(e.frequency,i.frequency,O)}.`)]},{name:"fastFly",title:"Faster, with the fruit fly's wing",flight:{...Qt,at:"last"},placeOf:"fast",view:{camera:"side",arrows:!0},pin:"fast",look:"curve",tell:({now:i,seen:t})=>[...S(t.fast,e=>`With the fruit fly's coefficients, power ${M(e.power,i.power)} ${T(i)}.`),"Neither wing is a bat's. The two answers show how much a result depends on that choice."]}]};var ee=[Jt,Zt,Yt,Xt],se={first:i=>i[0],last:i=>i.at(-1),cheapest:te,early:(i,t)=>je(i,t,.75*i[0][t]+.25*te(i)[t])};function te(i){return i.reduce((t,e)=>e.power<t.power?e:t)}function je(i,t,e){let s=n=>Math.abs(n[t]-e);return i.reduce((n,a)=>s(a)<s(n)?a:n)}var De=6,Y=class{constructor(t){this.face=t,this.calm=window.matchMedia("(prefers-reduced-motion: reduce)").matches,this.cards=ee.map(s=>this.card(s));let e=r("ul",{},...this.cards.map(({element:s})=>s));this.element=r("section",{class:"wbx-tours"},r("h2",{},"Guided tours"),e),this.build()}card(t){let e=r("button",{type:"button",onclick:()=>this.start(t,e)},t.title),s=r("span");return{story:t,button:e,words:s,element:r("li",{},e,s)}}offer(){for(let{story:t,button:e,words:s}of this.cards)e.disabled=!t.steps.some(n=>this.flight(n)),s.textContent=e.disabled?"This page has no flight of this tour.":t.teaser}build(){let t=(s,n,a={})=>r("button",{type:"button",onclick:n,...a},s);this.count=r("p",{class:"wbx-hint"}),this.title=r("h2",{tabindex:"-1"}),this.text=r("div",{class:"wbx-tour-text","aria-live":"polite"}),this.back=t("Back",()=>this.go(this.nth-1,-1)),this.again=t("Show this step again",()=>this.go(this.nth,1),{hidden:!0}),this.next=t("Next",()=>this.isLast?this.close():this.go(this.nth+1,1),{"data-go":"next"});let e=t("\xD7",()=>this.close(),{class:"wbx-close","aria-label":"Close the tour"});this.panel=r("section",{class:"wbx-tour","aria-label":"Guided tour",hidden:!0,onkeydown:s=>this.key(s)},r("div",{class:"wbx-row"},this.count,e),this.title,this.text,r("div",{class:"wbx-row"},this.back,this.again,this.next))}key(t){if(t.ctrlKey||t.metaKey||t.altKey)return;let e={ArrowRight:this.next,ArrowLeft:this.back}[t.key];if(t.key==="Escape")this.close();else if(e&&!e.disabled)e.click();else return;t.preventDefault(),t.stopPropagation()}start(t,e){this.before??=this.found(),Object.assign(this,{story:t,opener:e,seen:{}}),this.panel.hidden=!1,this.face.root.dataset.tour=t.name,this.title.focus({preventScroll:!0}),this.go(0,1)}found(){let{viewer:t,pins:e}=this.face;return{view:t&&lt(t),pinned:e.answer,ghost:e.ghost}}close(){let{viewer:t,pins:e}=this.face;this.pin(void 0),e.ghost!==this.before.ghost&&e.turn(),t&&this.before.view&&ht(t,this.before.view),this.before=void 0,this.panel.hidden=!0,this.step=void 0,delete this.face.root.dataset.tour,delete this.face.root.dataset.look,this.opener.focus()}flight({flight:t}){let e=t.at==="pushed",s={animal:t.animal,along:t.along??x.name},n=[t.model].flat().find(a=>this.face.has({...s,model:a,push:e}));return n&&{...s,model:n}}go(t,e){let{steps:s}=this.story,n=[],a=t;for(;s[a]&&!this.flight(s[a]);a+=e)n.push(s[a].title);let o=s.slice(a+1),h=!o.some(l=>this.flight(l));h&&n.push(...o.map(({title:l})=>l)),this.left=n.map(l=>`Left out, because this page has no such flight: \u201C${l}\u201D.`),Object.assign(this,{nth:a,step:s[a],ready:!1,tries:0,isLast:h}),this.count.textContent=`${this.story.title}: ${a+1} of ${s.length}`,this.title.textContent=this.step.title,this.back.disabled=!s.slice(0,a).some(l=>this.flight(l)),this.next.textContent=this.isLast?"Finish":"Next",this.again.hidden=!0,this.say(["Looking for this flight \u2026"]),this.ask()}heard(){this.step&&(this.ready?this.again.hidden=Ue(this.face.answer,this.shown):this.ask())}heardCurve(){this.step&&this.waitsForCurve&&!this.face.answer.provisional&&this.ask()}ask(){let{face:t,step:e}=this,{animal:s,along:n,model:a}=this.flight(e),{answer:o}=t;if(!(o?.species===s&&o.model===a&&t.curve.axis.name===n))return this.request({animal:s,along:n,model:a});let{pending:l=[],points:c}=t.curve.data;if(this.waitsForCurve=l.length>0,this.waitsForCurve)return this.say([`Computing the curve; ${l.length} more flights to go.`]);let p=this.place(c.filter(d=>d.certified));if(p!==void 0&&Math.abs(p-o[n])>1e-9)return this.request({at:p});if(e.push&&!o.scene?.pushes&&o.status==="converged")return this.say(["Flying through the gusts \u2026"]),t.onpush();this.arrive(o)}request(t){this.tries+=1,this.tries>De?this.finish(["This page does not have the flight of this step."]):this.face.ask(t)}place(t){let{step:e,seen:s,face:n}=this,{name:a}=n.curve.axis;return e.flight.at==="pushed"?n.pushedAt(n.answer):s[e.placeOf]?s[e.placeOf][a]:t.length?se[e.flight.at](t,a)[a]:void 0}arrive(t){let{step:e,seen:s}=this;if(this.ready=!0,t.status==="converged"&&(s[e.name]=t),this.pin(s[e.pin]),this.look(),e.push||this.face.viewer?.pushes.reset(),t.status!=="converged")return this.finish([t.sentence]);let n=e.push&&this.push(t.scene.pushes);if(e.push&&!n)return this.finish(["No feedback was found that holds this flight."]);this.finish(e.tell({now:t,seen:s,push:n,semiSpan:t.scene.flights[0].semi_span}))}finish(t){this.ready=!0,this.shown=this.face.answer,this.say(t)}say(t){let e=this.left.map(s=>r("p",{class:"wbx-hint"},s));this.text.replaceChildren(...e,...t.map(s=>r("p",{},..._t(s))))}pin(t){let{pins:e}=this.face,s=this.pinned&&e.answer===this.pinned,n=t??(s?this.before.pinned:e.answer);n!==e.answer&&e.pin(n),this.pinned=t}push(t){let{direction:e,feedback:s}=this.step.push,n=t.find(a=>a.direction===e&&a.feedback===s);return n&&this.face.viewer.pushes.choose(n),n}look(){let{viewer:t,root:e}=this.face;if(!t)return;let{camera:s,arrows:n}=this.step.view,a={resultant:n,lift:!1,drag:!1,trails:!0};t.setCamera(s);for(let h of t.root.querySelectorAll(".wb-toggle")){let l=h.querySelector("input"),c=a[h.textContent.trim()];c!==void 0&&l.checked!==c&&l.click()}e.dataset.look=this.step.look;let o=this.step.look==="picture"?t.picture:e.querySelector(`[data-part="${this.step.look}"]`);this.scroll(e,o)}scroll(t,e){let s=this.calm?"auto":"smooth",n=this.panel.offsetWidth<window.innerWidth?0:this.panel.offsetHeight;e.getBoundingClientRect().bottom-t.getBoundingClientRect().top<=window.innerHeight-n?t.scrollIntoView({block:"start",behavior:s}):e.scrollIntoView({block:"end",behavior:s})}};function Ue(i,t){return["species","model","speed",i.axis?.name].every(e=>i[e]===t[e])}var He={closes:["Closes","Does not close"],plausible:["Plausible","Not plausible"]},Ve=/(?<![\w.])(\d[\d.,]*(?:e[+-]?\d+)?(?: m\/s| W| times a second| times)?)/,X=class{constructor(){this.sentence=r("h1",{class:"wbx-sentence"}),this.lights=r("ul",{class:"wbx-lights","aria-label":"Verdict"}),this.summary=r("summary"),this.list=r("ul",{tabindex:"0","aria-label":"Warnings"}),this.warnings=r("details",{class:"wbx-warnings"},this.summary,this.list),this.warnings.open=window.matchMedia("(min-width: 900px)").matches,this.warnings.hidden=!0,this.element=r("div",{class:"wbx-verdict"},this.lights,this.warnings),this.spoken=r("p",{class:"wbx-unseen",role:"status"})}show(t){let e=t.sentence.split(Ve);this.sentence.replaceChildren(...e.map((o,h)=>h%2?r("b",{},o):o)),this.speak(t.sentence),this.lights.replaceChildren(...t.lights.map(o=>this.light(o)));let{warnings:s}=t;this.warnings.hidden=!1,this.warnings.classList.toggle("wbx-narrow",!s.length),t.status!=="converged"&&(this.warnings.open=!0);let n=s.length===1?"1 warning":`${s.length} warnings`;this.summary.replaceChildren(r("span",{class:"wbx-narrow"},"Reasons, "),n);let a=t.lights.map(({text:o})=>r("li",{class:"wbx-narrow"},o));this.list.replaceChildren(...a,...s.map(o=>r("li",{},o)))}speak(t){clearTimeout(this.later),this.later=setTimeout(()=>this.spoken.textContent=t,700)}light({name:t,good:e,known:s,text:n}){let a=e?"good":s===!1?"open":"bad",o=a==="open"?"Plausible? Not known":He[t][e?0:1],h=r("span",{class:"wbx-sign","aria-hidden":"true"},{good:"\u2713",bad:"!",open:"?"}[a]),l=r("span",{},r("strong",{},o)," ",r("span",{class:"wbx-why"},n));return r("li",{class:`wbx-light wbx-${a}`,"data-light":t},h,l)}};var Ge="the closest wingbeat: it does not fly",Ke=0,L=class{constructor(t,{theme:e="system",snap:s=!0}={}){this.onask=()=>{},this.onpush=void 0,this.onfile=void 0,this.onpushed=()=>{},this.theme=e,this.id=`wbx${++Ke}`,this.verdict=new X,this.curve=new _(n=>this.ask({at:n}),s),this.gauges=new j,this.pins=new V(()=>this.show()),this.tour=new Y(this),this.linked=new D(this),this.own=new H(this),this.root=r("section",{class:"wbx","aria-label":"Explorer"},r("style",{},Ft)),this.root.face=this,this.build(),this.setTheme(e),t.append(this.root)}build(){this.animal=this.choice("Animal",o=>this.ask({animal:o})),this.along=this.choice("Slider",o=>this.ask({along:o,at:void 0})),this.model=this.choice("Model",o=>this.ask({model:o}));let t=[this.animal,this.model,this.along].map(({element:o})=>o);this.choices=r("div",{class:"wbx-choices"},...t),this.state=r("p",{class:"wbx-state",role:"status"}),this.picture=r("div",{class:"wbx-picture"}),this.pushButton=r("button",{type:"button",class:"wbx-push",hidden:!0,onclick:()=>this.push()}),this.numbers=r("tbody");let e=r("table",{},this.numbers),s=r("details",{class:"wbx-more"},r("summary",{},"More numbers"),e),n=[r("h2",{},"Is this flight plausible?"),this.gauges.element,this.pins.element,s],a=r("div",{class:"wbx-judged","data-part":"gauges"},...n);this.root.append(r("header",{class:"wbx-say"},this.choices,this.verdict.sentence,this.verdict.spoken),r("div",{class:"wbx-side"},this.verdict.element,a),r("div",{class:"wbx-stage"},this.picture,this.pushButton,this.state,this.curve.element),r("div",{class:"wbx-extras"},this.tour.element,this.own.element),this.tour.panel)}choice(t,e){let s=`${this.id}-${t}`,n=r("select",{id:s,onchange:()=>e(n.value)});return{select:n,element:r("span",{class:"wbx-choice"},r("label",{for:s},t),n)}}setChoices({animals:t,models:e,axes:s=[x]},{animal:n,model:a,along:o=x.name}){this.asked={at:this.asked?.at,animal:n,model:a,along:o};let h=s.map(({name:c,label:p})=>({name:c,title:C(p)})),l=[[this.animal,t,n],[this.along,h,o],[this.model,e,a]];for(let[{select:c},p,d]of l)c.replaceChildren(...p.map(({name:f,title:u})=>r("option",{value:f},u))),c.value=d;this.along.element.hidden=s.length<2,this.tour.offer()}showCurve(t,e=x){let s=e.name!==this.curve.axis.name;this.curve.show(t,e),s&&this.own.show(),this.tour.heardCurve()}showAnswer(t){this.answer=t;let{name:e}=this.curve.axis;this.asked={animal:t.species,model:t.model,along:e,at:t[e]},this.animal.select.value=t.species,this.model.select.value=t.model,this.pins.now(t),this.say(""),this.show(),this.pushing&&this.isPushed(t)?this.push():this.linked.heard(),t.provisional||queueMicrotask(()=>this.tour.heard())}showPushes(t){let e=document.activeElement===this.pushButton;this.showAnswer({...this.answer,scene:{...this.answer.scene,pushes:t}}),e&&this.viewer.pushes.element.querySelector("select")?.focus()}showBetween(t){let{answer:e}=this;!e?.scene||this.pins.answer||(this.fly(t?{...e.scene,flights:[t]}:e.scene,e.species),this.label(e,t?.summary))}compare(t){this.pins.pin(t)}say(t){this.state.textContent=t}setTheme(t){this.theme=t,this.root.dataset.theme=t,this.viewer?.setTheme(t)}has({animal:t,model:e,along:s=x.name,push:n}){let a=({select:o},h)=>[...o.options].some(l=>l.value===h);return[[this.animal,t],[this.along,s],[this.model,e]].every(o=>a(...o))&&!(n&&!this.onpush)}pushedAt(t){return this.onpush&&t.status==="converged"?t[this.curve.axis.name]:void 0}isPushed(t){let e=this.pushedAt(t);return e!==void 0&&e===t[this.curve.axis.name]}ask(t){this.asked={...this.asked,...t},this.linked.want(""),this.onask({...this.asked})}push(){this.pushing=!this.isPushed(this.answer),this.pushing?this.ask({at:this.pushedAt(this.answer)}):this.onpush()}tellPush(){let{answer:t}=this,e=this.pushedAt(t);if(this.pushButton.hidden=e===void 0||!!t.scene?.pushes,e===void 0)return;let s=this.isPushed(t)?"":`, at ${y(e,this.curve.axis.unit)}`;this.pushButton.textContent=`Push it with a gust${s}`}show(){let{answer:t}=this;if(!t)return;let e=this.pins.answer;this.root.dataset.status=t.status,this.verdict.show(t),this.gauges.show(t.gauges,e?.gauges),this.curve.mark(t[this.curve.axis.name]),this.curve.pin(e?.status==="converged"?e:void 0),this.numbers.replaceChildren(...Ye(t,e)),this.picture.hidden=!t.scene,t.scene&&this.fly(this.pins.scene(t),t.species),this.label(t),t.scene||this.say("This flight tumbles before there is anything to show."),this.tellPush()}label({status:t},e=""){this.viewer&&(this.viewer.warning.textContent=t==="converged"?e:Ge,this.viewer.warning.classList.toggle("wbx-between",e!==""))}fly(t,e){let s=t.flights.length;if(this.blind)return;let n=e===this.whose&&s===this.count&&this.viewer?.ghost===this.pins.ghost;if(this.viewer)this.replace(t,n);else{try{this.viewer=new ot(this.picture,t,{theme:this.theme,compact:!0})}catch{this.blind=!0,this.picture.replaceChildren(r("p",{},"This browser cannot draw in three dimensions: WebGL is missing or switched off.")),this.own.show();return}this.own.show(),this.viewer.pushes.onchange=()=>this.onpushed()}e!==this.whose&&this.viewer.setBeat(1),[this.whose,this.count]=[e,s]}replace(t,e){let{camera:s,controls:n}=this.viewer.stage,[a,o]=[s.position.clone(),n.target.clone()];this.viewer.ghost=this.pins.ghost,this.viewer.replace(t),e&&(s.position.copy(a),n.target.copy(o),n.update())}destroy(){this.own.destroy(),this.curve.destroy(),this.viewer?.destroy(),this.root.remove()}};function Ye(i,t){let e=new Map((t?.numbers??[]).map(([a,o])=>[a,o])),s=i.numbers.map(([a,o,h])=>{let l=[r("td",{},o),...t?[r("td",{},e.get(a)??"\u2013")]:[]];return r("tr",{},r("th",{scope:"row"},a),...l,r("td",{},h))});if(!t)return s;let n=["","now","pinned",""].map(a=>r("th",{scope:"col"},a));return[r("tr",{},...n),...s]}var Xe=.5,Q=class{constructor(t,e){this.answers=t,this.axis=e,this.flights=new Map}at(t){let{name:e,unit:s}=this.axis,n=this.answers.findIndex(d=>d[e]>=t),[a,o]=[this.answers[n-1],this.answers[n]];if(!a||!o||o[e]===t||!ie(a)||!ie(o))return;let[h,l]=[this.flight(a),this.flight(o)];if(!Qe(h,l))return;let c=(t-a[e])/(o[e]-a[e]),p=`Picture between the wingbeats at ${v(a[e])} and ${y(o[e],s)}`;return{...Je(h,l,c),summary:p}}flight(t){return this.flights.has(t)||this.flights.set(t,new rt(t.scene.flights[0])),this.flights.get(t)}},ie=({status:i,scene:t})=>i==="converged"&&t;function Qe(i,t){let[e,s]=[i.arrays.corners,t.arrays.corners];if(i.samples!==t.samples||e.length!==s.length)return!1;let n=(Xe*i.semi_span)**2;for(let a=0;a<e.length;a+=3)if([0,1,2].reduce((h,l)=>h+(s[a+l]-e[a+l])**2,0)>n)return!1;return!0}function Je(i,t,e){let s=e<.5?i:t,n={};for(let a of Object.keys(s.arrays)){let[o,h]=[i.arrays[a],t.arrays[a]],l=o?.length===h?.length;n[a]=l?o.map((c,p)=>c+e*(h[p]-c)):s.arrays[a]}return{...s,arrays:n,frequency:i.frequency+e*(t.frequency-i.frequency)}}var J=class{constructor(t,e){this.catalogue=e,this.lattices=new Map,this.pushes=new Map,this.asked=e.start,this.face=new L(t,{}),this.face.onask=s=>this.ask(s),this.face.curve.onslide=s=>this.slide(s),this.face.onpush=()=>this.push(),this.face.onpushed=()=>this.link(),this.face.has=s=>this.has(s),this.face.pushedAt=({species:s,model:n,axis:a=x})=>this.pushedAt({animal:s,model:n,along:a.name}),window.addEventListener("hashchange",()=>this.follow()),this.follow()}follow(){let t=this.fragment();this.asked=Ze(this.asked,t),this.face.linked.want(t.push??""),this.ask(this.asked)}fragment(){let t=new URLSearchParams(location.hash.slice(1)),e={};this.catalogue.animals.some(({name:s})=>s===t.get("animal"))&&(e.animal=t.get("animal")),this.catalogue.models.some(({name:s})=>s===t.get("model"))&&(e.model=t.get("model"));for(let{name:s}of this.catalogue.axes)Number.isFinite(parseFloat(t.get(s)))&&([e.along,e.at]=[s,parseFloat(t.get(s))]);return t.get("push")&&(e.push=t.get("push")),e}has({push:t=!1,...e}){return this.catalogue.files.includes(`${N(e)}${t?"-pushes":""}.js`)}axes(t){let{axes:e,models:s}=this.catalogue;return e.filter(({name:n})=>s.some(({name:a})=>this.has({animal:t,model:a,along:n})))}models(t,e){return this.catalogue.models.filter(({name:s})=>this.has({animal:t,model:s,along:e}))}ask(t){let{animal:e}=t,s=this.axes(e),n=s.some(({name:c})=>c===t.along)?t.along:s[0].name,a=this.models(e,n),o=a.some(({name:c})=>c===t.model)?t.model:a[0].name,h=e===this.asked.animal&&n===t.along;this.asked={animal:e,along:n,model:o,at:h?t.at:void 0};let l=`${e}/${n}`;this.listed!==l&&this.face.setChoices({animals:this.catalogue.animals,models:a,axes:s},this.asked),this.listed=l,this.load()}load(){let t=N(this.asked);if(this.lattices.has(t))return this.show(this.lattices.get(t));this.face.say("Loading \u2026"),this.read(t)}read(t){let e=`data/${t}.js`;document.head.append(r("script",{src:e,onerror:()=>this.face.say(`The file ${e} could not be read.`)}))}async hold(t,e){let s=await this.decompressed(e);if(s){for(let n of s.answers){n.axis=s.axis;for(let a of n.gauges)a.source??=s.sources[a.name]}this.lattices.set(t,s),N(this.asked)===t&&this.show(s)}}pushedAt(t){return this.has({...t,push:!0})?this.lattices.get(N(t))?.first:void 0}push(){let t=N(this.asked),e=this.pushes.get(t);if(e)return this.face.showPushes(e);this.face.say("Loading the gusts \u2026"),this.read(`${t}-pushes`)}async holdPushes(t,e){let s=await this.decompressed(e);if(!s)return;this.pushes.set(t,s);let{asked:n}=this;N(n)===t&&n.at===this.pushedAt(n)&&this.face.showPushes(s)}async decompressed(t){try{return await ts(t)}catch{this.face.say("This browser cannot unpack the data; a newer one can.");return}}show(t){let{name:e}=t.axis,s=a=>Math.abs(a[e]-(this.asked.at??t.first)),n=t.answers.reduce((a,o)=>s(o)<s(a)?o:a);this.shown!==t&&(this.face.showCurve(t.curve,t.axis),this.between=new Q(t.answers,t.axis)),this.shown=t,this.asked.at=n[e],this.face.showAnswer(n),this.link()}slide(t){this.sliding=t,this.due??=requestAnimationFrame(()=>{this.due=void 0;let e=this.sliding===void 0?void 0:this.between?.at(this.sliding);(e||this.isBetween)&&this.face.showBetween(e),this.isBetween=!!e})}link(){let{animal:t,model:e,along:s,at:n}=this.asked,a=this.face.linked.name;history.replaceState(null,"",`#${new URLSearchParams({animal:t,model:e,[s]:n,...a&&{push:a}})}`)}};function Ze(i,{animal:t,model:e,along:s,at:n}){return{...t?{animal:t,along:s,at:n}:{animal:i.animal,along:s??i.along,at:n??i.at},model:e??i.model}}async function ts(i){let t=Uint8Array.from(atob(i),s=>s.charCodeAt(0)),e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return JSON.parse(await new Response(e).text())}function N({animal:i,model:t,along:e=x.name}){return[i,t,...e===x.name?[]:[e]].join("-")}var at;globalThis.wingbeatExplorer={explore:(i,t={})=>new L(i,t),mount:ct,open:i=>at=new J(document.querySelector("main"),i),hold:(i,t)=>at.hold(i,t),holdPushes:(i,t)=>at.holdPushes(i,t)};})();
